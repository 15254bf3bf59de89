// obstruct from the command line.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

constexpr const char* kFamily =
    "title = \"Henon and Heiles\"\nsource = \"a test\"\n"
    "hamiltonian = \"(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3\"\n"
    "[phase_space]\nvariables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n"
    "[parameters]\nc = {}\n[[scene]]\nname = \"default\"\nparameters = { c = \"-1\" }\n"
    "initial = { x = \"0\", y = \"0\", px = \"1\", py = \"0\" }\n";

TEST(Obstruct, ProvesWithTheEvidence) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome outcome = run_in(folder, {"obstruct", file, "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto json = outcome.json();
  EXPECT_EQ(json.at("verdict"), "proved");
  EXPECT_EQ(json.at("along"), "x = 0, px = 0");
  EXPECT_EQ(json.at("parameters").at("c"), "-1");
  for (const char* key : {"case", "level", "nve", "theorem", "excluded", "seconds"})
    EXPECT_TRUE(json.contains(key)) << key;
  // Cases 1 to 3 with their reasons, and Kimura's theorem.
  EXPECT_EQ(json.at("examined").back().at("cases").size(), 7u);
}

TEST(Obstruct, IsUndecidedForAnIntegrableSystem) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  for (const char* c : {"c=1", "c=6"}) {
    const Outcome outcome = run_in(folder, {"obstruct", file, "--param", c, "--json"});
    EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.json().at("verdict"), "undecided");
    EXPECT_FALSE(outcome.json().at("reason").get<std::string>().empty());
  }
  EXPECT_EQ(run({"obstruct", "kovalevskaya"}).status, 3);
}

TEST(Obstruct, TellsWhatSurvivesOfAFreeParameter) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome outcome = run_in(folder, {"obstruct", file, "--free", "c", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto free = outcome.json().at("free");
  EXPECT_EQ(free.at("parameter"), "c");
  // At c = 0 the equation is Mathieu's, with an irregular point: rational integrals are excluded.
  ASSERT_EQ(free.at("survivors").size(), 3u);
  EXPECT_EQ(free.at("survivors").at(0).at("value"), "0");
  EXPECT_EQ(free.at("survivors").at(2).at("value"), "6");
  for (const auto& alone : free.at("excluded_alone")) EXPECT_NE(alone.at("value"), "0");
  EXPECT_EQ(free.at("sequences").size(), 1u);
  const Outcome text = run_in(folder, {"obstruct", file, "--free", "c"});
  EXPECT_NE(text.out.find("survives    c = 6"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("for every other real c"), std::string::npos);
  // What has a value is not free, nor is what is no parameter.
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--free", "d"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--free", "c", "--param", "c=1"}).status, 2);
}

/// At c = 0 there is an integral with Airy's functions, meromorphic and not rational: what excludes
/// the rational ones does not put c = 0 among the values without a meromorphic one.
TEST(Obstruct, AValueWithoutRationalIntegralsAloneSurvives) {
  const Folder folder;
  const std::string file = folder.write("airy.toml", R"toml(
hamiltonian = "p1 + (p2^2 + q1*q2^2/((1 + c^2*q1)^2*(1 + 2*c^2*q1)))/2"
[phase_space]
variables = ["q1", "q2", "p1", "p2"]
canonical = true
[parameters]
c = {}
)toml");
  const Outcome outcome = run_in(folder, {"obstruct", file, "--free", "c", "--json"});
  const auto free = outcome.json().at("free");
  EXPECT_TRUE(free.at("excluded_alone").empty()) << outcome.out;
  ASSERT_EQ(free.at("survivors").size(), 1u);
  EXPECT_EQ(free.at("survivors").at(0).at("value"), "0");
  const Outcome text = run_in(folder, {"obstruct", file, "--free", "c"});
  EXPECT_TRUE(has(text.out, "survives    c = 0")) << text.out;
  EXPECT_TRUE(has(text.out, "rational integrals alone")) << text.out;
}

TEST(Obstruct, SaysWhichOrderDecides) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome third = run_in(folder, {"obstruct", file, "--param", "c=2", "--json"});
  ASSERT_EQ(third.status, 0) << third.out << third.err;
  EXPECT_EQ(third.json().at("examined").back().at("order"), 3);
  EXPECT_TRUE(has(third.json().at("theorem"), "Simo"));
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--param", "c=2", "--order", "2"}).status, 3);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--order", "9"}).status, 2);
}

/// Exit status of coqc on a file of the folder.
int checked_by_coq(const Folder& folder, const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.path().c_str()) != 0) _exit(126);
    const int said = open("said", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    execlp("coqc", "coqc", file.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

TEST(Obstruct, CoqAcceptsTheLinearAlgebraAndRejectsWhatWasTamperedWith) {
  const Folder folder;
  const std::string file =
      folder.write("quartic.toml",
                   "title = \"Yang and Mills\"\nsource = \"a test\"\n"
                   "hamiltonian = \"(px^2 + py^2 + x^2 + y^2)/2 + x^2*y^2\"\n[phase_space]\n"
                   "variables = [\"x\", \"y\", \"px\", \"py\"]\ncanonical = true\n");
  const Outcome outcome = run_in(folder, {"obstruct", file, "--certificate", "right.v", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.json().at("certificate").at("file"), "right.v");
  std::string text = file_text(folder.path() / "right.v");
  ASSERT_TRUE(has(text, "Theorem no_polynomial_")) << text.substr(text.size() / 2);
  // Nothing of the case.
  for (const char* word : {"quartic", "Mills", "px"}) EXPECT_FALSE(has(text, word)) << word;
  const int status = checked_by_coq(folder, "right.v");
  if (status == 127) GTEST_SKIP() << "coqc is not installed";
  ASSERT_EQ(status, 0) << file_text(folder.path() / "said");
  folder.write("assumptions.v", "Require Import right.\nPrint Assumptions no_polynomial_1.\n");
  if (has(text, "no_polynomial_1")) {
    EXPECT_EQ(checked_by_coq(folder, "assumptions.v"), 0);
    EXPECT_EQ(file_text(folder.path() / "said"), "Closed under the global context\n");
  }
  // A witness that tells nothing apart.
  const std::size_t place = text.find("[", text.find(":=", text.find("Definition witnesses_")) + 4);
  ASSERT_NE(place, std::string::npos);
  text.insert(place + 1, "1; ");
  folder.write("wrong.v", text);
  EXPECT_EQ(checked_by_coq(folder, "wrong.v"), 1);
}

TEST(Obstruct, ThereIsNoCertificateOfWhatIsNotProved) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome outcome =
      run_in(folder, {"obstruct", file, "--param", "c=1", "--certificate", "none.v", "--json"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(outcome.json().at("certificate").is_null());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.v"));
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--certificate", "a b.v"}).status, 2);
}

TEST(Obstruct, VerifyAndShowSayIt) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  const Outcome verify = run_in(folder, {"verify", file, "--obstruct", "--json"});
  EXPECT_EQ(verify.json().at("further_integral").at("verdict"), "proved");
  EXPECT_TRUE(
      has(run_in(folder, {"verify", file, "--obstruct"}).out, "further integral: excluded"));
  EXPECT_FALSE(run_in(folder, {"verify", file, "--json"}).json().contains("further_integral"));
  const auto integrable = run({"verify", "kovalevskaya", "--obstruct", "--json"}).json();
  EXPECT_TRUE(integrable.at("further_integral").is_null());
  EXPECT_EQ(run({"verify", "--all", "--obstruct"}).status, 2);
  const Outcome show = run_in(folder, {"show", file, "--nve"});
  EXPECT_TRUE(has(show.out, "py^2 = ")) << show.out;
  EXPECT_TRUE(has(show.out, "u'' + ")) << show.out;
  const Outcome latex = run_in(folder, {"show", file, "--nve", "--format", "latex"});
  EXPECT_TRUE(has(latex.out, "\\frac")) << latex.out;
  EXPECT_FALSE(run_in(folder, {"show", file, "--nve", "--json"}).json().at("nve").empty());
}

TEST(Obstruct, RefusesWhatIsNoSurface) {
  const Folder folder;
  const std::string file = folder.write("family.toml", kFamily);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "x = 0"}).status, 0);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "w = 0"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--along", "x +"}).status, 2);
  EXPECT_EQ(run_in(folder, {"obstruct", file, "--param", "d=1"}).status, 2);
}

}  // namespace
}  // namespace casimir::test
