// section --horseshoe, branches and crossings of many orbits from the command line.
#include <gtest/gtest.h>

#include "tests/tools/program.hpp"
#include "tools/text/runs/horseshoe_report.hpp"

namespace casimir::test {
namespace {

/// Duffing's equation, forced by a point that runs round a circle.
std::string duffing(const std::string& force) {
  return "title = \"Duffing\"\n[phase_space]\nvariables = [\"c\", \"s\", \"x\", \"y\"]\n"
         "[equations]\nc = \"-s\"\ns = \"c\"\nx = \"y/4\"\ny = \"(x - x^3)/4 + " +
         force +
         "\"\n[integrals]\nR = \"c^2 + s^2\"\n[[scene]]\nname = \"default\"\n"
         "initial = { c = \"1\", s = \"0\", x = \"1/10\", y = \"1/7\" }\nduration = \"10\"\n";
}

TEST(HorseshoeCommand, ATheoremHasItsSetsAndItsHypotheses) {
  const Folder folder;
  const std::string file = folder.write("duffing.toml", duffing("c/12"));
  const Outcome outcome = run_in(folder, {"section", file, "--horseshoe", "--plane", "s", "--json",
                                          "--certificate", "chaos.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto json = outcome.json();
  const Outcome checked = run_in(folder, {"check", "chaos.json", "--json"});
  ASSERT_EQ(checked.status, 0) << checked.out << checked.err;
  EXPECT_EQ(checked.json().at("certificate"), "horseshoe");
  EXPECT_EQ(checked.json().at("entropy"), json.at("entropy"));
  EXPECT_EQ(checked.json().at("level"), json.at("level"));
  EXPECT_EQ(json.at("verdict"), "proved");
  EXPECT_GT(number(json.at("entropy")), 0);
  EXPECT_GT(json.at("coverings").size(), json.at("sets").size());
  EXPECT_EQ(json.at("sets")[0].at("centre").size(), 4U);
  EXPECT_EQ(json.at("hypotheses").size(), 6U);
  EXPECT_TRUE(has(json.at("theorem").get<std::string>(), "no further real-analytic integral"));
  EXPECT_EQ(json.at("level").size(), 1U);
}

/// The theorem is not about the level that ten digits say, where that is another one.
TEST(HorseshoeReport, TheLevelIsTheOneThatIsProved) {
  Horseshoe answer;
  answer.system.level_names = {"H", "C", "D", "E"};
  const cln::cl_RA third = cln::cl_RA(1) / 3, fine = cln::expt(cln::cl_RA(10), cln::cl_I(-12));
  const cln::cl_RA eighth = cln::cl_RA(1) / 8;
  answer.system.levels = {
      {third, third}, {eighth - fine, eighth + fine}, {eighth + fine, eighth + fine}, {0, 0}};
  const std::string text = tools::HorseshoeReport{"c", "s", answer, 0}.theorem();
  EXPECT_TRUE(has(text, "H in [0.333333333333")) << text;
  EXPECT_TRUE(has(text, "C = 0.125,")) << text;
  EXPECT_TRUE(has(text, "D = 0.125000000001,")) << text;
  EXPECT_TRUE(has(text, "E = 0 ")) << text;
}

TEST(HorseshoeCommand, NotFoundIsNoTheorem) {
  const Outcome outcome =
      run({"section", "kovalevskaya", "--horseshoe", "--time-limit", "0.2", "--json"});
  EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.json().at("verdict"), "not found");
  EXPECT_FALSE(outcome.json().contains("theorem"));
}

TEST(HorseshoeCommand, SaysWhatItCannotDo) {
  const Folder folder;
  const std::string file = folder.write("duffing.toml", duffing("c/12"));
  const auto refused = [&](std::vector<std::string> words, const std::string& part) {
    const Outcome outcome = run_in(folder, words);
    EXPECT_EQ(outcome.status, 2) << part << outcome.out << outcome.err;
    EXPECT_TRUE(has(outcome.err, part)) << outcome.err;
  };
  refused({"section", file, "--horseshoe"}, "--plane");
  refused({"section", file, "--horseshoe", "--plane", "s", "--energy", "1"}, "energy");
  refused({"section", file, "--horseshoe", "--plane", "s", "--points", "5"}, "--horseshoe");
  refused({"section", "euler", "--horseshoe", "--plane", "M1"}, "dimension");
  refused({"section", "euler-poisson", "--param", "a1=1..1.001"}, "range");
  refused({"section", "euler-poisson", "--horseshoe", "--param", "a1=1..1.001"},
          "a horseshoe is proved for one value of each parameter");
}

TEST(ValidatedSections, CrossingsOfManyOrbitsAndBranches) {
  const Outcome outcome = run(
      {"section", "henon-heiles", "--validated", "--orbits", "2", "--duration", "10", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto json = outcome.json();
  ASSERT_EQ(json.at("orbits").size(), 2U);
  for (const auto& orbit : json.at("orbits")) {
    EXPECT_EQ(orbit.at("status"), "ok");
    EXPECT_EQ(orbit.at("start").size(), 4U);
    EXPECT_GE(orbit.at("validated").at("count"), 1);
  }
  const Outcome branch =
      run({"equilibria", "henon-heiles", "--validated", "--param", "A=1..1.001", "--json"});
  ASSERT_EQ(branch.status, 0) << branch.out << branch.err;
  EXPECT_EQ(branch.json().at("for_every"), "A in [1, 1.001]");
}

}  // namespace
}  // namespace casimir::test
