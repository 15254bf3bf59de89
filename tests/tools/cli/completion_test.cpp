// What a shell offers at the tabulator key: asked of the program, and typed into real shells.
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>

#include <algorithm>
#include <chrono>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Words = std::vector<std::string>;

/// The words that may stand in place of the last one, without what they mean.
Words offered(Words words, const Environment& environment = {}) {
  words.insert(words.begin(), "complete");
  const Outcome outcome = run(words, {}, environment);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  Words result;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);)
    result.push_back(line.substr(0, line.find('\t')));
  return result;
}

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(Completion, CommandsAreThoseOfTheHelp) {
  const std::string help = run({"--help"}).out;
  const Words commands = offered({""});
  EXPECT_GE(commands.size(), 15U);
  for (const std::string& name : commands)
    EXPECT_NE(help.find("\n  " + name + " "), std::string::npos) << name;
  EXPECT_EQ(offered({"ver"}), Words{"verify"});
  EXPECT_EQ(offered({"--v"}), Words{"--version"});
  EXPECT_EQ(offered({"nonsense", ""}), Words{});
}

TEST(Completion, OptionsAreThoseOfTheCommand) {
  for (const std::string& command : offered({""})) {
    const std::string help = run({command, "--help"}).out;
    const Words options = offered({command, "--"});
    EXPECT_TRUE(contains(options, "--json")) << command;
    for (const std::string& option : options)
      EXPECT_NE(help.find(option), std::string::npos) << command << ' ' << option;
  }
  EXPECT_TRUE(contains(offered({"verify", "x", "--integral", "M1", "--"}), "--integral"));
  EXPECT_FALSE(contains(offered({"verify", "x", "--json", "--"}), "--json"));
}

TEST(Completion, CasesAreTheBundledOnesAndThoseOfTheEnvironment) {
  EXPECT_EQ(offered({"verify", "steklov-e"}), (Words{":files", "steklov-euler-poisson"}));
  EXPECT_EQ(offered({"check", "k"}), Words{":files"});
  const Folder folder;
  folder.write("steklov-extra.toml", "");
  EXPECT_TRUE(
      contains(offered({"verify", "steklov-e"}, {{"CASIMIR_CASES", folder.path().string()}}),
               "steklov-extra"));
  EXPECT_EQ(offered({"verify", "euler", ""}), Words{});  // one is enough
  EXPECT_TRUE(contains(offered({"bench", "euler", "stek"}), "steklov"));
  EXPECT_EQ(offered({"list", ""}), Words{});
}

TEST(Completion, ValuesFollowFromTheOptionAndTheCase) {
  EXPECT_EQ(offered({"integrate", "euler", "--method", "gauss1"}), (Words{"gauss12", "gauss16"}));
  EXPECT_TRUE(contains(offered({"integrate", "euler-angles", "--scene", ""}), "from-quaternions"));
  EXPECT_EQ(offered({"integrate", "--scene=d"}), Words{});  // of no case
  EXPECT_EQ(offered({"integrate", "euler-angles", "--scene=from"}),
            Words{"--scene=from-quaternions"});
  EXPECT_EQ(offered({"verify", "kovalevskaya", "--param", ""}), Words{"r="});
  EXPECT_EQ(offered({"generate", "euler", "--language", ""}), (Words{"c", "c++"}));
  EXPECT_EQ(offered({"section", "euler", "--direction", ""}), (Words{"up", "down"}));
  EXPECT_EQ(offered({"generate", "euler", "--output", ""}), Words{":files"});
  EXPECT_TRUE(contains(offered({"verify", "--all", "--tag", "kirch"}), "kirchhoff"));
  EXPECT_TRUE(contains(offered({"show", "euler-e3", "--as", "and"}), "andoyer"));
}

TEST(Completion, ListsGoOnBehindTheComma) {
  EXPECT_EQ(offered({"generate", "euler", "--with", "rhs,j"}), Words{"rhs,jacobian"});
  EXPECT_EQ(offered({"generate", "euler", "--with", "rhs,r"}), Words{});
  EXPECT_EQ(offered({"bench", "--method", "taylor,dop8"}), Words{"taylor,dop853"});
}

TEST(Completion, ACaseThatCannotBeReadOffersNothing) {
  const Folder folder;
  const std::string broken = folder.write("broken.toml", "title = ");
  EXPECT_EQ(offered({"integrate", broken, "--scene", ""}), Words{});
  EXPECT_EQ(offered({"integrate", "-", "--scene", ""}), Words{});
}

/// A shell at a terminal. Everything that is waited for must come within a long time.
class Shell {
 public:
  explicit Shell(Words command) {
    child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (child_ != 0) return;
    const std::string folder = std::filesystem::path(CASIMIR_PROGRAM).parent_path();
    const std::string path = folder + ":/usr/local/bin:/usr/bin:/bin";
    for (const auto& [name, value] : Environment{{"PATH", path},
                                                 {"HOME", home_.path().string()},
                                                 {"INPUTRC", "/dev/null"},
                                                 {"PS1", "$ "},
                                                 {"TERM", "vt100"}})
      setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> pointers;
    for (std::string& word : command) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;
  ~Shell() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    close(terminal_);
  }

  void type(const std::string& text) {
    EXPECT_EQ(write(terminal_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  /// Whether the text is shown before a minute is over.
  testing::AssertionResult shows(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (shown_.find(text) == std::string::npos) {
      pollfd waiting{terminal_, POLLIN, 0};
      char buffer[4096];
      const bool late = std::chrono::steady_clock::now() > end;
      const ssize_t count = !late && poll(&waiting, 1, 1000) == 0 ? 0
                            : late                                ? -1
                                   : read(terminal_, buffer, sizeof buffer);
      if (count < 0) return testing::AssertionFailure() << text << " not in\n" << shown_;
      shown_.append(buffer, static_cast<std::size_t>(count));
    }
    shown_.clear();
    return testing::AssertionSuccess();
  }

 private:
  Folder home_;
  int terminal_ = -1;
  pid_t child_ = -1;
  std::string shown_;
};

std::string script(const std::string& shell) {
  return CASIMIR_SOURCE_DIR "/tools/usage/casimir." + shell;
}

/// Types the beginnings of words; what the program answers shows what became of them.
void expect_completed_commands(Shell& shell) {
  shell.type("casimir verif\tsteklov-e\t\n");
  EXPECT_TRUE(shell.shows("(steklov-euler-poisson, "));
  shell.type("casimir integr\teuler-ang\t--sce\tfrom\t--durat\t1\n");
  EXPECT_TRUE(shell.shows(", scene 'from-quaternions'"));
  shell.type("casimir integrate euler-angles --scene=from\t--method=dop8\t--duration 1\n");
  EXPECT_TRUE(shell.shows(", scene 'from-quaternions', dop853"));
  shell.type("casimir verify kovalevskaya --para\tr\t1/2 --integral H --quiet; echo status-$?\n");
  EXPECT_TRUE(shell.shows("status-0"));
  shell.type("echo > my-own.toml; echo written-$?\n");
  ASSERT_TRUE(shell.shows("written-0"));
  shell.type("casimir verify my-o\t\n");
  EXPECT_TRUE(shell.shows("my-own.toml:1"));
  shell.type("casimir generate euler --output=my-o\t && head -n 1 my-own.toml\n");
  EXPECT_TRUE(shell.shows("// Written by casimir"));
  shell.type("casimir list --js\t --tag kirch\t | wc -c; echo done-$?\n");
  EXPECT_TRUE(shell.shows("done-0"));
}

TEST(Completion, BashCompletesTypedWords) {
  Shell shell({"bash", "--norc", "--noprofile", "-i"});
  shell.type("cd; bind 'set enable-bracketed-paste off'; source " + script("bash") +
             "; echo ready-$?\n");
  ASSERT_TRUE(shell.shows("ready-0"));
  expect_completed_commands(shell);
}

TEST(Completion, ZshCompletesTypedWords) {
  Shell shell({"zsh", "-f", "-i"});
  shell.type("cd; autoload -U compinit; compinit -u -D; source " + script("zsh") +
             "; echo ready-$?\n");
  ASSERT_TRUE(shell.shows("ready-0"));
  expect_completed_commands(shell);
}

TEST(Completion, FishCompletesWords) {
  const Folder folder;
  const auto fish = [&](const std::string& line) {
    const std::string output = folder / "output";
    const std::string build = std::filesystem::path(CASIMIR_PROGRAM).parent_path();
    const std::string command = "cd '" + folder.path().string() + "' && HOME=. PATH='" + build +
                                ":/usr/bin:/bin' fish --no-config -c 'source " + script("fish") +
                                "; complete -C \"" + line + "\"' > '" + output + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    Words words;
    std::istringstream lines(file_text(output));
    for (std::string word; std::getline(lines, word);)
      words.push_back(word.substr(0, word.find('\t')));
    return words;
  };
  folder.write("my-own.toml", "");
  EXPECT_EQ(fish("casimir verif"), Words{"verify"});
  EXPECT_EQ(fish("casimir verify steklov-e"), Words{"steklov-euler-poisson"});
  EXPECT_EQ(fish("casimir verify my-o"), Words{"my-own.toml"});
  EXPECT_EQ(fish("casimir verify euler --sce"), Words{"--scene"});
  EXPECT_EQ(fish("casimir integrate euler-angles --scene from"), Words{"from-quaternions"});
  EXPECT_EQ(fish("casimir integrate euler-angles --scene=from"), Words{"--scene=from-quaternions"});
  EXPECT_EQ(fish("casimir generate euler --output=my-o"), Words{"--output=my-own.toml"});
}

}  // namespace
}  // namespace casimir::test
