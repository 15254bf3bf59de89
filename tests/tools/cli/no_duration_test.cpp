// A scene without a duration is good for all that needs no end of a run.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

const std::string kText =
    "hamiltonian = \"(M1^2 + M2^2 + 2*M3^2)/2 - g1\"\n[phase_space]\n"
    "variables = [\"M1\", \"M2\", \"M3\", \"g1\", \"g2\", \"g3\"]\nalgebra = \"e(3)\"\n[casimirs]\n"
    "F1 = \"g1^2 + g2^2 + g3^2\"\nF2 = \"M1*g1 + M2*g2 + M3*g3\"\n[section]\nfunction = "
    "\"g2\"\nplot = [\"M1\", \"M3\"]\n"
    "[[scene]]\nname = \"endless\"\ninitial = { M1 = \"1\", M2 = \"1/2\", M3 = \"1/3\", g1 = "
    "\"3/5\", "
    "g2 = \"0\", g3 = \"4/5\" }\n";

TEST(NoDuration, ProofsHeadersAndSectionsDoNotNeedIt) {
  const Folder folder;
  EXPECT_EQ(run({"verify", "-"}, kText).status, 0);
  EXPECT_EQ(run({"show", "-"}, kText).status, 0);
  const Outcome header = run({"generate", "-"}, kText);
  EXPECT_EQ(header.status, 0) << header.err;
  EXPECT_EQ(header.out.find("duration"), std::string::npos) << header.out;
  const Outcome c = run({"generate", "-", "--language", "c"}, kText);
  EXPECT_EQ(c.status, 0) << c.err;
  EXPECT_EQ(c.out.find("duration"), std::string::npos) << c.out;
  const Outcome section = run_in(
      folder, {"section", "-", "--orbits", "1", "--points", "2", "--output", "s.csv"}, kText);
  EXPECT_EQ(section.status, 0) << section.err;
}

TEST(NoDuration, OfNoTimeTheFileHasTheStart) {
  const Folder folder;
  const std::string file = folder.write("top.toml", kText);
  ASSERT_EQ(run_in(folder, {"integrate", file, "--duration", "0", "--output", "o.csv"}).status, 0);
  const std::string text = file_text(folder.path() / "o.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_NE(text.find("\n0,1,0.5,"), std::string::npos) << text;
}

TEST(NoDuration, IntegrationSaysWhereItIsMissing) {
  const Folder folder;
  const std::string file = folder.write("top.toml", kText);
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"integrate", file},
           {"integrate", file, "--digits", "20"},
           {"conserve", file},
           {"bench", file, "--quiet"},
           {"stress", file},
           {"sweep", file, "--over", "M1=1:2:2", "--output", folder / "x.csv"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.status, 2) << command[0] << outcome.err;
    EXPECT_NE(outcome.err.find("top.toml:12:9: error: the scene 'endless' has no duration\n"),
              std::string::npos)
        << command[0] << outcome.err;
    EXPECT_NE(outcome.err.find("duration = \"100\""), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder.files(), 1U);
}

TEST(NoDuration, TheOptionTakesItsPlace) {
  const Outcome outcome = run({"integrate", "-", "--duration", "2", "--json"}, kText);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("t"), "2");
  EXPECT_EQ(run({"integrate", "-", "--duration", "2", "--digits", "20"}, kText).status, 0);
  EXPECT_EQ(run({"conserve", "-", "--duration", "2"}, kText).status, 0);
}

TEST(NoDuration, AReferenceStateNeedsOne) {
  const Outcome outcome = run({"show", "-"}, kText +
                                                 "reference = { M1 = \"1\", M2 = \"1\", M3 = "
                                                 "\"1\", g1 = \"1\", g2 = \"0\", g3 = \"0\" }\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("has a reference state but no duration"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace casimir::test
