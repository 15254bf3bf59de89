// casimir --initial: another start than that of the scene.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

/// H of kovalevskaya's default scene with another M1, M2: (M1^2 + M2^2 + 2 M3^2)/2 - g1.
double energy(const Outcome& outcome) {
  return number(outcome.json().at("invariants").at("H").at("initial"));
}

TEST(Initial, ReplacesOneVariableAndKeepsTheOthers) {
  const std::vector<std::string> command = {"integrate", "kovalevskaya", "--json", "--duration",
                                            "1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  };
  const Outcome plain = with({}), same = with({"--initial", "M1=1"});
  EXPECT_EQ(plain.json().at("state"), same.json().at("state"));
  EXPECT_NEAR(energy(with({"--initial", "M1=2"})), energy(plain) + 1.5, 1e-12);
  EXPECT_NEAR(energy(with({"--initial", "M1=2", "--initial", "M2=sqrt(2)/2"})),
              energy(plain) + 1.5 + 0.125, 1e-12);
}

TEST(Initial, MultiprecisionTakesTheExactNumber) {
  const Outcome outcome = run(
      {"integrate", "euler", "--digits", "30", "--duration", "0", "--json", "--initial", "M1=1/3"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("state").at("M1").get<std::string>().find(
                "0.33333333333333333333333333333"),
            0U)
      << outcome.out;
}

TEST(Initial, TheReferenceStateOfAnotherStartIsNotUsed) {
  const auto rows = [](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"conserve", "kovalevskaya", "--json", "--method", "dop853", "--scene", "default"});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.json().at("rows");
  };
  EXPECT_FALSE(rows({}).at(0).at("error").is_null());
  EXPECT_TRUE(rows({"--initial", "M1=6/5"}).at(0).at("error").is_null());
}

TEST(Initial, HeadersStartThere) {
  const Outcome outcome = run({"generate", "euler", "--initial", "M1=7/4"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("initial_state[] = {1.75, "), std::string::npos) << outcome.out;
}

TEST(Initial, ASectionIsOnTheLevelOfThatStart) {
  const Folder folder;
  const auto level = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"section", "kovalevskaya", "--json", "--orbits", "1", "--points",
                               "3", "--output", "s.csv"});
    const Outcome outcome = run_in(folder, more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return file_text(folder.path() / "s.csv");
  };
  const std::string plain = level({});
  EXPECT_EQ(level({"--initial", "M3=1/3"}), plain);
  EXPECT_NE(level({"--initial", "M3=1/2"}), plain);
}

TEST(Initial, AStartOffTheLevelsOfItsSceneIsRefused) {
  const std::string text =
      "hamiltonian = \"(M1^2 + 2*M2^2 + 3*M3^2)/2\"\n[phase_space]\n"
      "variables = [\"M1\", \"M2\", \"M3\"]\nalgebra = \"so(3)\"\n[[scene]]\nname = \"default\"\n"
      "initial = { M1 = \"1\", M2 = \"0\", M3 = \"0\" }\non = [\"M1^2 + M2^2 + M3^2 - 1\"]\n"
      "duration = \"1\"\n";
  EXPECT_EQ(run({"integrate", "-"}, text).status, 0);
  EXPECT_EQ(run({"integrate", "-", "--initial", "M1=-1"}, text).status, 0);
  const Outcome off = run({"integrate", "-", "--initial", "M1=2"}, text);
  EXPECT_EQ(off.status, 2);
  EXPECT_NE(off.err.find("is not on the level M1^2 + M2^2 + M3^2 - 1 = 0: the value there is 3"),
            std::string::npos)
      << off.err;
}

}  // namespace
}  // namespace casimir::test
