// No string of a case file and no word of a command line reaches a terminal, a shell, a file name,
// gnuplot, HTML, LaTeX or generated code as anything but text.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// Each of less than 200 characters: names are not longer.
const std::vector<std::string>& payloads() {
  static const std::vector<std::string> all = {
      "PWNED\"'\n#include \"PWNED.h\"\nPWNED \"\\\" '\\' \"\"\" '''",
      "$(touch PWNED)`touch PWNED`;touch PWNED|touch PWNED&touch PWNED\n!touch PWNED",
      "*/ PWNED /* // PWNED */\nPWNED; #error PWNED ?\?/\nPWNED R\"(PWNED)\" \\",
      "\x1b[31mPWNED\x1b[0m\x1b]0;PWNED\x07\x1bP PWNED\x1b\\ \x7f\x08\r\xc2\x9b"
      "31m\xc2\x9d"
      "0;P\xc2\x9c\xc2\x85",
      "../../PWNED/../PWNED.hpp /etc/PWNED ~/PWNED -o PWNED --PWNED",
      "\xe2\x80\xae"
      "DENWP\xe2\x81\xa6\xe2\x80\x8b\xef\xbb\xbf\xe2\x80\xa8\xd0\xb0\xd1\x81\xf3\xa0\x81\x81",
      "<script>PWNED</script><img src=x onerror=PWNED>]]>&lt;\" onclick='PWNED' javascript:PWNED",
      "{} {0} %s%n %1$s \\input{PWNED} $PWNED$ \\write18{PWNED} ^^41 }}{{ set output '|PWNED'"};
  return all;
}

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    char escaped[8];
    std::snprintf(escaped, sizeof escaped, "\\u%04x", code);
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else
      result += code < 0x20 || code == 0x7f ? std::string(escaped) : std::string(1, c);
  }
  return result + "\"";
}

/// A good case all of whose free texts are hostile: the first is payload `turn`, and so on.
std::string hostile_case(std::size_t turn) {
  const auto next = [&] { return toml_string(payloads()[turn++ % payloads().size()]); };
  std::string text = "title = " + next() + "\nsource = " + next() + "\nbook = " + next() +
                     "\ntags = [" + next() + ", " + next() + "]\n";
  text += R"toml(hamiltonian = "(M1^2 + M2^2 + 2*M3^2)/2 + sin(a)*g1/9"
[phase_space]
variables = ["M1", "M2", "M3", "g1", "g2", "g3"]
algebra = "e(3)"
[parameters]
a = { assume = "a  !=\r\n\t 0" }
[casimirs]
F1 = "g1^2 +\r g2^2 + g3^2"
F2 = "M1*g1 + M2*g2 + M3*g3"
)toml";
  text += "[[conditional]]\nexpression = \"F1\"\non = [\"M1\\r*M2\\f\"]\nname = " + next();
  text += "\n[[invariant_relation]]\nexpression = \"F1\"\nname = " + next();
  text += "\n[[identity]]\nleft = \"M1\"\nright = \"M2\"\nname = " + next();
  text += "\n[[map]]\nto = \"e(3)\"\nname = " + next() +
          "\nexpressions = { M1 = \"M1\", M2 = \"M2\", M3 = \"M3\", g1 = \"g1\", g2 = \"g2\", g3 = "
          "\"g3\" }\n";
  text += "[section]\nfunction = \"M3\"\nplot = [\"M1\", \"M2\"]\nlabels = [" + next() + ", " +
          next() + "]\n";
  text += "[[scene]]\nname = " + next() +
          "\nparameters = { a = \"1\" }\nduration = \"1\"\n"
          "initial = { M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\", g1 = \"3/5\", g2 = \"0\", g3 = "
          "\"4/5\" }\n";
  return text;
}

/// The first character that does more than stand there, as \x1b; empty if there is none.
std::string deceptive_character(const std::string& text) {
  static const std::regex all(
      "[\\x01-\\x08\\x0b-\\x1f\\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8b-\x8f\xa8-\xae]|\xe2\x81[\xa0-"
      "\xaf]|"
      "\xef\xbb\xbf|\xf3\xa0",
      std::regex::optimize);
  std::smatch found;
  if (!std::regex_search(text, found, all)) return {};
  std::string shown;
  for (const char c : found.str()) {
    char byte[8];
    std::snprintf(byte, sizeof byte, "\\x%02x", static_cast<unsigned char>(c));
    shown += byte;
  }
  return shown +
         " in: " + found.prefix().str().substr(std::max<std::ptrdiff_t>(found.position() - 60, 0));
}

void expect_plain(const Outcome& outcome, const std::string& what) {
  EXPECT_EQ(deceptive_character(outcome.out), "") << what;
  EXPECT_EQ(deceptive_character(outcome.err), "") << what;
}

std::vector<std::string> names_in(const Folder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

class HostileCase : public testing::TestWithParam<std::size_t> {};

TEST_P(HostileCase, IsShownAndProvedAsPlainText) {
  const Folder folder;
  folder.write("case.toml", hostile_case(GetParam()));
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"verify"},
                                             {"verify", "--json"},
                                             {"show"},
                                             {"show", "--format", "json"},
                                             {"show", "--format", "latex"},
                                             {"show", "--scene", payloads()[GetParam()]},
                                             {"equilibria"},
                                             {"search", "--degree", "1"},
                                             {"integrate", "--param", "a=2"}}) {
    std::vector<std::string> arguments = options;
    arguments.insert(arguments.begin() + 1, "./case.toml");
    const Outcome outcome = run_in(folder, arguments);
    const std::string what = options[0] + " " + options.back();
    EXPECT_LE(outcome.status, 3) << what << outcome.err;
    expect_plain(outcome, what);
    if (options.back() == "latex") {
      EXPECT_EQ(outcome.out.find("\\input{PWNED"), std::string::npos);
      EXPECT_EQ(outcome.out.find("\\write18"), std::string::npos);
    }
  }
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"case.toml"});
}

INSTANTIATE_TEST_SUITE_P(All, HostileCase, testing::Range<std::size_t>(0, payloads().size()));

/// `source` without comments and string literals.
std::string code_of(const std::string& source) {
  return std::regex_replace(source, std::regex("\"([^\"\\\\\n]|\\\\.)*\"|//[^\n]*"), "");
}

TEST(HostileStrings, AreCommentsInGeneratedCode) {
  const Folder folder;
  for (std::size_t turn = 0; turn < payloads().size(); ++turn) {
    folder.write("case.toml", hostile_case(turn));
    const Outcome outcome = run_in(
        folder, {"generate", "./case.toml", "--with", "rhs,invariants", "--output", "out.hpp"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_plain(outcome, "generate");
    const std::string code = file_text(folder / "out.hpp");
    EXPECT_TRUE(std::all_of(code.begin(), code.end(),
                            [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
    EXPECT_EQ(code.find("\\\n"), std::string::npos) << "a comment that goes on in the next line";
    EXPECT_EQ(code_of(code).find("PWNED"), std::string::npos) << code;
    EXPECT_EQ(std::system(("c++ -std=c++20 -Wall -Wextra -Werror -fsyntax-only -x c++ '" +
                           (folder / "out.hpp") + "'")
                              .c_str()),
              0);
    std::filesystem::remove(folder / "out.hpp");
  }
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"case.toml"});
}

TEST(HostileStrings, AreTextInModulesPicturesAndPages) {
  const Folder folder;
  folder.write("case.toml", hostile_case(3));
  const std::vector<std::vector<std::string>> runs = {
      {"integrate", "./case.toml", "--method", "dop853", "--output", "out.csv", "--every", "0.5"},
      {"integrate", "./case.toml", "--plot", "out.svg"},
      {"section", "./case.toml", "--orbits", "2", "--points", "4", "--output", "section.svg"},
      {"bench", "./case.toml", "--method", "taylor,dop853", "--tolerances", "1e-6,1e-9", "--repeat",
       "1", "--output", "bench.html", "--plot", "bench.svg"},
      {"report", "./case.toml", "--output", "out.html", "--budget", "0"}};
  for (const std::vector<std::string>& arguments : runs) {
    const Outcome outcome =
        run_in(folder, arguments, {}, {{"CASIMIR_CACHE", (folder.path() / "cache").string()}});
    EXPECT_LE(outcome.status, 1) << arguments[0] << outcome.out << outcome.err;
    expect_plain(outcome, arguments[0]);
  }
  for (const char* name :
       {"out.csv", "out.svg", "section.svg", "bench.html", "bench.svg", "out.html"})
    EXPECT_EQ(deceptive_character(file_text(folder / name)), "") << name;
  for (const char* page : {"out.html", "bench.html"}) {
    for (const char* raw : {"<script>PWNED", "<img src=x", "onclick='PWNED"})
      EXPECT_EQ(file_text(folder / page).find(raw), std::string::npos) << page << raw;
  }
  EXPECT_EQ(names_in(folder),
            (std::vector<std::string>{"bench.html", "bench.svg", "cache", "case.toml", "out.csv",
                                      "out.html", "out.svg", "section.svg"}));
}

// What has to be a name or an expression is refused, and the message is plain.
TEST(HostileStrings, AreNoNamesAndNoExpressions) {
  const std::vector<std::string> fields = {
      "[phase_space]\nvariables = [@, \"p\"]\ncanonical = true",
      "[phase_space]\nvariables = [\"q\", \"p\"]\nalgebra = @",
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\ndomain = [@]",
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\nconstraints = [@]",
      "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\ntime = @",
      "[phase_space]\nvariables = [\"q\", \"p\"]\n[phase_space.brackets]\n@ = \"1\"",
      "[phase_space]\nvariables = [\"q\", \"p\"]\n[phase_space.brackets]\n\"q,p\" = @",
      "#\n[parameters]\n@ = {}",
      "#\n[parameters]\na = { assume = @ }",
      "#\n[definitions]\n@ = \"1\"",
      "#\n[definitions]\na = @",
      "#\n[integrals]\n@ = \"q\"",
      "#\n[integrals]\na = @",
      "#\n[[conditional]]\nname = \"a\"\nexpression = @\non = [\"q\"]",
      "#\n[[conditional]]\nname = \"a\"\nexpression = \"q\"\non = [@]",
      "#\n[[lax]]\nspectral = @\nL = [[\"q\"]]\nA = [[\"q\"]]",
      "#\n[[lax]]\nL = [[@]]\nA = [[\"q\"]]",
      "#\n[[map]]\nname = \"a\"\nto = @\nexpressions = { q = \"q\" }",
      "#\n[[measure]]\ndensity = @",
      "#\n[section]\nfunction = \"q\"\ndirection = @",
      "#\n[[scene]]\nname = \"a\"\nduration = @\ninitial = { q = \"1\", p = \"1\" }",
      "#\n[[scene]]\nname = \"a\"\nduration = \"1\"\ninitial = { q = @, p = \"1\" }",
      "#\n[[scene]]\nname = \"a\"\nduration = \"1\"\ninitial = { q = \"1\", p = \"1\" }\nextreme = "
      "@",
      "#\n[[scene]]\nname = \"a\"\nduration = \"1\"\ninitial = { q = \"1\", p = \"1\" }\nobserve = "
      "[@]",
      "#\n@ = 1"};
  std::vector<std::string> texts = payloads();
  texts.push_back(std::string(10000, 'x'));
  texts.emplace_back("\xd0\xb0");       // Cyrillic a
  texts.emplace_back("q\xe2\x80\x8b");  // a space of no width
  texts.emplace_back("int");
  const Folder folder;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    // Each field with some of the texts: all pairs would take long.
    for (std::size_t t = k % 3; t < texts.size(); t += 3) {
      std::string text = "hamiltonian = \"q\"\n";
      if (fields[k][0] == '#')
        text += "[phase_space]\nvariables = [\"q\", \"p\"]\ncanonical = true\n";
      text += fields[k];
      text.replace(text.find('@'), 1, toml_string(texts[t]));
      if (fields[k].ends_with("@ = 1")) text = text.substr(text.rfind('\n') + 1) + "\n" + text;
      folder.write("case.toml", text);
      const Outcome outcome = run_in(folder, {"verify", "./case.toml"});
      EXPECT_EQ(outcome.status, 2) << text << outcome.out << outcome.err;
      EXPECT_LT(outcome.err.size(), 1500U);
      expect_plain(outcome, text);
    }
  }
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"case.toml"});
}

TEST(HostileStrings, OfTenThousandCharactersAreNoNames) {
  std::string text = hostile_case(0);
  const std::size_t scene = text.rfind("name = ");
  text.replace(scene, text.find('\n', scene) - scene, "name = \"" + std::string(10000, 'n') + "\"");
  const Outcome outcome = run({"show", "-"}, text);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("longer than 200 characters"), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.err.size(), 1000U);
}

TEST(HostileFileNames, AreText) {
  const Folder folder;
  std::string name =
      "$(touch PWNED)`touch PWNED`;'\"\x1b[31m\xc2\x9b"
      "31m\xe2\x80\xae|PWNED.toml";
  folder.write(name, hostile_case(0));
  folder.write("|touch PWNED;.toml", hostile_case(1));
  const std::size_t before = folder.files();
  for (const std::string& file : {name, std::string("|touch PWNED;.toml")}) {
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"verify"}, {"show"}, {"exponents"}, {"integrate"}}) {
      std::vector<std::string> arguments = options;
      arguments.insert(arguments.begin() + 1, "./" + file);
      expect_plain(run_in(folder, arguments), options[0]);
    }
  }
  EXPECT_EQ(folder.files(), before);
  const Outcome picture = run_in(folder, {"integrate", "euler", "--plot", "|touch PWNED;.svg"});
  EXPECT_EQ(picture.status, 0) << picture.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "|touch PWNED;.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "PWNED"));
}

TEST(HostileCommandLines, AreReportedAsPlainText) {
  for (const std::string& text : payloads()) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {text},
             {"verify", text},
             {"verify", "./" + text},
             {"verify", "euler", "--" + text},
             {"verify", "euler", "--param", text},
             {"verify", "euler", "--param", text + "=1"},
             {"verify", "euler", "--param", "a1=" + text},
             {"verify", "euler", "--scene", text},
             {"verify", "euler", "--integral", text},
             {"verify", "euler", "--integral", "M1^2\r + M2"},
             {"verify", "euler", "--integral", "M1", "--on", text},
             {"verify", "euler", "--time-limit", text},
             {"verify", "euler", "--limit", text},
             {"verify", "euler", "--certificate", text},
             {"integrate", "euler", "--method", text},
             {"integrate", "euler", "--duration", text},
             {"integrate", "euler", "--plot", text},
             {"integrate", "euler", "--output", "/nowhere/" + text, "--every", "1"},
             {"generate", "euler", "--observe", text},
             {"generate", "euler", "--output", "/nowhere/" + text},
             {"list", "--tag", text}}) {
      const Outcome outcome = run(arguments);
      EXPECT_NE(outcome.status, 134) << arguments.back() << outcome.err;
      EXPECT_LE(outcome.status, 4) << arguments.back();
      expect_plain(outcome, arguments[0] + " " + arguments.back());
    }
  }
}

}  // namespace
}  // namespace casimir::test
