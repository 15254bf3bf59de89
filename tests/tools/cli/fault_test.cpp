// Files, pipes, compilers and signals at fault: exit status 4 and a message that can be read, no
// half-written file, and a cache that the next run can use.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <set>
#include <thread>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

namespace fs = std::filesystem;

/// Runs lines of a shell, in which "$C" is the program.
Outcome shell(const Folder& folder, const std::string& lines, const Environment& environment = {}) {
  const fs::path out = folder.path() / ".stdout", err = folder.path() / ".stderr";
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.path().c_str()) != 0) _exit(127);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    setenv("C", CASIMIR_PROGRAM, 1);
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    execl("/bin/sh", "sh", "-c", lines.c_str(), nullptr);
    _exit(127);
  }
  return finish(child, folder);
}

std::string program(const Folder& folder, const char* name, const std::string& lines) {
  const std::string path = folder.write(name, "#!/bin/sh\n" + lines + "\n");
  chmod(path.c_str(), 0700);
  return path;
}

Environment cache_in(const Folder& folder) {
  return {{"CASIMIR_CACHE", (folder.path() / "cache").string()}};
}

TEST(Fault, StandardOutputThatIsFullIsSaid) {
  const Folder folder;
  for (const char* command :
       {"list", "list --json", "show kovalevskaya", "show kovalevskaya --format latex", "--help",
        "verify euler", "verify --all --tag free-body", "integrate euler --json", "integrate euler",
        "--version", "generate euler -o e.hpp", "search euler --degree 2", "exponents euler"}) {
    const Outcome outcome = shell(folder, std::string("\"$C\" ") + command + " > /dev/full");
    EXPECT_EQ(outcome.status, 4) << command;
    EXPECT_EQ(outcome.err,
              "casimir: error: cannot write to standard output: No space left on device\n")
        << command;
  }
  EXPECT_EQ(shell(folder, "\"$C\" verify euler --quiet > /dev/full").status, 0);
}

TEST(Fault, StandardOutputThatIsClosedIsSaidAndNoFileTakesItsPlace) {
  const Folder folder;
  const Outcome outcome = shell(folder, "\"$C\" integrate euler --output o.csv >&-");
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find("cannot write to standard output"), std::string::npos) << outcome.err;
  const std::string text = file_text(folder / "o.csv");
  EXPECT_TRUE(text.starts_with("t,M1,M2,M3\n")) << text.substr(0, 100);
  EXPECT_EQ(text.find("euler"), std::string::npos);
  // Nor where there is nothing to print.
  EXPECT_EQ(shell(folder, "\"$C\" integrate euler --quiet --output o.csv >&- 2>&- <&-").status, 0);
  EXPECT_EQ(file_text(folder / "o.csv"), text);
}

TEST(Fault, AReaderThatLeavesIsNoError) {
  const Folder folder;
  for (const char* command :
       {"list", "verify --all", "show kovalevskaya --format json", "integrate euler"}) {
    // Far more than a pipe holds, for any command that goes on.
    const Outcome outcome =
        shell(folder, std::string("(\"$C\" ") + command + "; echo $? > status) | head -c 10");
    EXPECT_TRUE(outcome.err.empty()) << command << outcome.err;
    EXPECT_EQ(outcome.out.size(), 10U) << command;
    const std::string status = file_text(folder / "status");
    EXPECT_TRUE(status == "0\n" || status == "141\n") << command << status;
  }
  // It does not work on for nobody, and leaves no half-written file.
  fs::remove(folder / "status");
  const Outcome outcome = shell(folder, "\"$C\" integrate euler --output /dev/stdout | :");
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  EXPECT_EQ(folder.files(), 0U);
}

TEST(Fault, AFileWithoutRoomKeepsTheOldOne) {
  const Folder folder;
  const std::string old = "<!-- survey -->\n<!-- /survey -->\n";
  for (const auto& [name, command] : std::vector<std::pair<const char*, std::string>>{
           {"f.csv", "integrate euler --every 0.01 --output f.csv"},
           {"f.csv", "integrate euler --digits 30 --every 0.01 --output f.csv"},
           {"f.svg", "integrate euler --plot f.svg"},
           {"f.png", "integrate euler --plot f.png"},
           {"f.csv", "sweep euler --over a1=1:2:200 --output f.csv"},
           {"f.h5", "sweep euler --over a1=1:2:200 --output f.h5"},
           // HDF5 itself would write this much where the file is closed.
           {"f.h5", "integrate euler --duration 1 --every 0.5 --output f.h5"},
           {"f.hpp", "generate manakov-so5 -o f.hpp"},
           {"f.v", "verify manakov-so5 --certificate f.v"},
           {"f.html", "report euler-jacobi --budget 0 --output f.html"},
           {"f.csv", "section henon-heiles --output f.csv"},
           {"f.svg", "section henon-heiles --output f.svg"},
           {"f.csv",
            "bench euler --method taylor,dop853 --tolerances "
            "1e-3,1e-4,1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11,1e-12 "
            "--budget 0.01 --output f.csv"},
           {"f.md", "survey --tag free-body --output f.md"},
           {"f.toml", "new f --algebra 'so(5)' --force"}}) {
    SCOPED_TRACE(command);
    folder.write(name, old);
    // Blocks of 512 bytes: no file longer than 1 KB.
    const Outcome outcome =
        shell(folder, "ulimit -f 2; \"$C\" " + command + " > out 2> err; s=$?; rm out; exit $s");
    const std::string err = file_text(folder / "err");
    EXPECT_EQ(outcome.status, 4) << err;
    EXPECT_NE(err.find("casimir: error: "), std::string::npos) << err;
    EXPECT_EQ(file_text(folder / name), old);
    for (const auto& entry : fs::directory_iterator(folder.path()))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    for (const auto& entry : fs::directory_iterator(folder.path())) fs::remove_all(entry.path());
  }
}

TEST(Fault, WhatIsNoFileIsWrittenToAndNotReplaced) {
  const Folder folder;
  const Outcome piped = shell(folder, "\"$C\" integrate euler --quiet --output /dev/stdout | cat");
  EXPECT_EQ(piped.status, 0);
  EXPECT_TRUE(piped.out.starts_with("t,M1,M2,M3\n0,1,")) << piped.out.substr(0, 100);
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
  EXPECT_EQ(shell(folder, "\"$C\" generate euler -o /dev/null").status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const Outcome full = shell(folder, "\"$C\" integrate euler --output /dev/full");
  EXPECT_EQ(full.status, 4);
  EXPECT_NE(full.err.find("'/dev/full': No space left on device"), std::string::npos) << full.err;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  fs::create_directory(folder / "sub");
  const Outcome taken = shell(folder, "\"$C\" integrate euler --output sub");
  EXPECT_EQ(taken.status, 4);
  EXPECT_NE(taken.err.find("'sub': Is a directory"), std::string::npos) << taken.err;
  EXPECT_EQ(folder.files(), 1U);
}

TEST(Fault, ALinkStaysALinkAndAFileKeepsItsMode) {
  const Folder folder;
  fs::create_directory(folder / "sub");
  folder.write("sub/target.csv", "old");
  chmod((folder / "sub/target.csv").c_str(), 0640);
  fs::create_symlink("sub/target.csv", folder / "link.csv");
  ASSERT_EQ(shell(folder, "\"$C\" integrate euler --quiet --output link.csv").status, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_TRUE(file_text(folder / "sub/target.csv").starts_with("t,M1"));
  struct stat info {};
  ASSERT_EQ(stat((folder / "sub/target.csv").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777, 0640U);
}

TEST(Fault, ACompilerThatHangsIsStoppedAndSaid) {
  const Folder folder;
  Environment environment = cache_in(folder);
  environment.emplace_back("CXX", program(folder, "cxx", "trap '' TERM; sleep 1000"));
  environment.emplace_back("CASIMIR_COMPILE_SECONDS", "0.5");
  const Outcome outcome =
      run_in(folder, {"integrate", "euler", "--method", "dop853"}, {}, environment);
  EXPECT_EQ(outcome.status, 4);
  EXPECT_TRUE(outcome.err.starts_with("casimir: error: the C++ compiler ")) << outcome.err;
  EXPECT_NE(outcome.err.find("was stopped after 0.5 s"), std::string::npos) << outcome.err;
}

TEST(Fault, ACompilerThatMakesNothingIsSaid) {
  const Folder folder;
  Environment environment = cache_in(folder);
  environment.emplace_back("CXX", "/bin/true");
  for (const char* scene : {"euler", "kovalevskaya"}) {
    const Outcome outcome =
        run_in(folder, {"integrate", scene, "--method", "dop853"}, {}, environment);
    EXPECT_EQ(outcome.status, 4);
    EXPECT_NE(outcome.err.find("cannot be loaded"), std::string::npos) << outcome.err;
  }
}

TEST(Fault, CtrlCEndsACompilerThatHangsAndAllThatItStarted) {
  const Folder folder;
  Environment environment = cache_in(folder);
  environment.emplace_back(
      "CXX", program(folder, "cxx",
                     "trap '' TERM INT\nsleep 1000 & echo $! > note.new\nmv note.new note\nwait"));
  const pid_t child = start({"integrate", "euler", "--method", "dop853"}, folder, {}, environment);
  while (!fs::exists(folder / "note")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child, folder).status, 130);
  const std::string stat =
      "/proc/" + std::to_string(std::stoi(file_text(folder / "note"))) + "/stat";
  const auto runs = [&] {
    const std::string text = file_text(stat);
    return !text.empty() && text[text.rfind(") ") + 2] != 'Z';
  };
  for (int i = 0; i < 1000 && runs(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(runs());
  for (const auto& entry : fs::directory_iterator(folder / "cache"))
    EXPECT_FALSE(entry.path().filename().string().starts_with("work-")) << entry.path();
}

TEST(Fault, ManyAtOnceOnAColdCacheAgree) {
  const Folder folder;
  const Outcome outcome = shell(folder,
                                "for i in $(seq 60); do \"$C\" integrate euler --method dop853 "
                                "--json > $i.json & done; wait",
                                cache_in(folder));
  EXPECT_EQ(outcome.err, "");
  std::set<std::string> states;
  int compiled = 0;
  for (int i = 1; i <= 60; ++i) {
    const auto json =
        nlohmann::ordered_json::parse(file_text(folder.path() / (std::to_string(i) + ".json")));
    states.insert(json.at("state").dump());
    compiled += json.at("from_cache") == false;
  }
  EXPECT_EQ(states.size(), 1U);
  EXPECT_EQ(compiled, 1);
}

TEST(Fault, KilledAtAnyMomentItLeavesTheOldFileOrTheNewOne) {
  const Folder folder;
  const Environment environment = cache_in(folder);
  const std::vector<std::string> arguments{"integrate", "euler", "--method", "dop853", "--quiet",
                                           "--every",   "0.01",  "--output", "o.csv"};
  unsigned random = 2024;
  std::string complete;
  for (int i = 0; i < 40; ++i) {
    folder.write("o.csv", "old");
    if (i % 4 == 0) fs::remove_all(folder / "cache");  // compiles
    const pid_t child = start(arguments, folder, {}, environment);
    random = random * 1664525U + 1013904223U;
    std::this_thread::sleep_for(
        std::chrono::microseconds((random >> 8) % (i % 4 == 0 ? 250000 : 40000)));
    kill(child, SIGKILL);
    finish(child, folder);
    const std::string text = file_text(folder / "o.csv");
    if (text == "old") continue;
    if (complete.empty()) {
      ASSERT_EQ(run_in(folder, arguments, {}, environment).status, 0);
      complete = file_text(folder / "o.csv");
    }
    EXPECT_EQ(text, complete);
  }
  EXPECT_EQ(run_in(folder, arguments, {}, environment).status, 0);
  if (complete.empty()) complete = file_text(folder / "o.csv");
  EXPECT_EQ(file_text(folder / "o.csv"), complete);
  EXPECT_GT(complete.size(), 100000U);
}

TEST(Fault, BoundsThatAreNoneAreSaid) {
  const Folder folder;
  for (const char* name : {"CASIMIR_CACHE_SIZE", "CASIMIR_COMPILE_SECONDS"}) {
    Environment environment = cache_in(folder);
    environment.emplace_back(name, "plenty");
    const Outcome outcome =
        run_in(folder, {"integrate", "euler", "--method", "dop853"}, {}, environment);
    EXPECT_EQ(outcome.status, 4);
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace casimir::test
