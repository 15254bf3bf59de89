// Orbits of maps as cases: what casimir integrate says of their errors.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

using Json = nlohmann::ordered_json;

/// A declared integral that changes is no fault of the orbit: it is none.
TEST(MapOrbits, AnIntegralThatIsRefutedIsNamed) {
  const Folder folder;
  folder.write(
      "turn.toml",
      "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"y\"\n"
      "y = \"-x\"\n[integrals]\nE = \"x^2 + y^2\"\nK = \"x*y\"\n[[scene]]\nname = \"default\"\n"
      "initial = { x = \"1\", y = \"1/2\" }\nduration = \"7\"\n");
  const std::string warnings =
      run_in(folder, {"integrate", "./turn.toml", "--json"}).json().at("warnings").dump();
  EXPECT_TRUE(has(warnings, "K changes by 2.0e+00 of its size, and it is refuted")) << warnings;
  EXPECT_FALSE(has(warnings, "E changes")) << warnings;
}

/// sqrt(x)^2 is x for x that are not negative; the orbit ends at the first other one.
TEST(MapOrbits, WhatTheMapWasWrittenWithHasValues) {
  const Folder folder;
  folder.write("down.toml",
               "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"x - 1\"\n"
               "y = \"sqrt(x)^2\"\n[[scene]]\nname = \"default\"\n"
               "initial = { x = \"3\", y = \"0\" }\nduration = \"7\"\n");
  const Outcome ended = run_in(folder, {"integrate", "./down.toml", "--json"});
  EXPECT_NE(ended.status, 0);
  EXPECT_EQ(ended.json().at("status"), "non_finite");
  EXPECT_EQ(ended.json().at("steps"), 4);
  EXPECT_TRUE(has(ended.err, "sqrt(x), which the map was written with, has no value")) << ended.err;
  // The second step has a value nowhere behind the first: log(w) and log(y) cancel in their
  // composition.
  folder.write("steps.toml",
               "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\", \"w\"]\n[[map_step]]\n"
               "expressions = { y = \"-1 - x^2\", w = \"-1 - x^2\" }\n[[map_step]]\n"
               "expressions = { x = \"x + log(y) - log(w)\" }\n[[scene]]\nname = \"default\"\n"
               "initial = { x = \"1\", y = \"2\", w = \"1\" }\nduration = \"3\"\n");
  EXPECT_EQ(run_in(folder, {"integrate", "./steps.toml", "--json"}).json().at("status"),
            "non_finite");
  // A flow does not come from x > 0 to x < 0 where it has the pole of 1/x; a map does.
  folder.write("over.toml",
               "title = \"t\"\n[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"x - 2\"\n"
               "y = \"1/x + log(x) - log(x)\"\n[[scene]]\nname = \"default\"\n"
               "initial = { x = \"3\", y = \"0\" }\nduration = \"7\"\n");
  EXPECT_EQ(run_in(folder, {"integrate", "./over.toml", "--json"}).json().at("steps"), 2);
}

// x -> 4 x (1 - x) is sin(u)^2 -> sin(2 u)^2.
TEST(MapOrbits, RoundingOfAnOrbitIsEstimated) {
  const Folder folder;
  std::ofstream(folder.path() / "logistic.toml") << R"toml(title = "logistic"
[phase_space]
variables = ["x"]
[map]
x = "4*x*(1 - x)"
[[scene]]
name = "default"
initial = { x = "1/3" }
duration = "20"
)toml";
  for (const int steps : {0, 10, 20, 30}) {
    const Json json = run_in(folder, {"integrate", "./logistic.toml", "--duration",
                                      std::to_string(steps), "--json"})
                          .json();
    const long double end =
        std::pow(std::sin(std::ldexp(std::asin(std::sqrt(1 / 3.L)), steps)), 2.L);
    const auto error =
        static_cast<double>(std::abs(std::stod(json.at("state").at("x").get<std::string>()) - end));
    const double estimate = json.at("trust").at("error_estimate");
    EXPECT_GT(estimate, error / 3) << steps;
    // Relative to the state at the end.
    EXPECT_LT(estimate, 1000 * (error + 1e-15) / static_cast<double>(end)) << steps;
    EXPECT_TRUE(json.at("warnings").empty());
  }
  const Json lost =
      run_in(folder, {"integrate", "./logistic.toml", "--duration", "100", "--json"}).json();
  EXPECT_TRUE(lost.at("trust").at("beyond_double"));
  EXPECT_EQ(lost.at("warnings").size(), 1u);
}

/// 3/5 and 4/5 are no doubles, so that the circle grows in each step, and 1/3 is rounded in the
/// same way again and again: both errors grow with the number of steps, not with its root.
// x = 0.813.., in fractions, where doubles have lost all digits beside the pole on the way.
TEST(MapOrbits, ASingularityThatIsConfinedTakesItsDigitsAlong) {
  const Folder folder;
  folder.write("confined.toml", R"toml([phase_space]
variables = ["x", "y"]
[map]
x = "y"
y = "-x + 1/y + 1/y^2"
[[scene]]
name = "default"
initial = { x = "1/3", y = "1/10^8" }
duration = "6"
)toml");
  const auto of_start = [&](const std::string& y) {
    return run_in(folder, {"integrate", "./confined.toml", "--initial", "y=" + y, "--json"}).json();
  };
  // 1/3 - x comes from 1/3 to 0 exactly, which is no loss.
  folder.write("zero.toml", R"toml([phase_space]
variables = ["x"]
[map]
x = "1/3 - x"
[[scene]]
name = "default"
initial = { x = "1/3" }
duration = "101"
)toml");
  const auto zero = run_in(folder, {"integrate", "./zero.toml", "--json"}).json();
  EXPECT_LT(zero.at("trust").at("error_estimate"), 1e-12);
  EXPECT_TRUE(zero.at("warnings").empty());
  const auto lost = of_start("1/10^8"), some = of_start("1/10^5"), none = of_start("1/3");
  EXPECT_GT(lost.at("trust").at("error_estimate"), 0.1);
  EXPECT_FALSE(lost.at("warnings").empty());
  EXPECT_GT(some.at("trust").at("error_estimate"), 1e-6);
  EXPECT_LT(some.at("trust").at("error_estimate"), 1e-2);
  EXPECT_LT(none.at("trust").at("error_estimate"), 1e-10);
}

TEST(MapOrbits, ErrorsOfRoundedNumbersAreEstimated) {
  const Folder folder;
  const std::string scene = "[[scene]]\nname = \"default\"\n";
  folder.write("turn.toml",
               "[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"3/5*x - 4/5*y\"\n"
               "y = \"4/5*x + 3/5*y\"\n[integrals]\nE = \"x^2 + y^2\"\n" +
                   scene + "initial = { x = \"1\", y = \"0\" }\nduration = \"10000000\"\n");
  folder.write("add.toml",
               "[phase_space]\nvariables = [\"x\", \"p\"]\n[map]\nx = \"x + p\"\n"
               "p = \"p\"\n" +
                   scene + "initial = { x = \"1\", p = \"1/3\" }\nduration = \"10000000\"\n");
  const auto estimate = [&](const char* file) {
    const Json json = run_in(folder, {"integrate", file, "--json"}).json();
    return std::pair(json, json.at("trust").at("error_estimate").get<double>());
  };
  const auto [turn, of_turn] = estimate("./turn.toml");
  const double drift = std::abs(number(turn.at("invariants").at("E").at("final")) - 1);
  EXPECT_GT(drift, 1e-10) << "the test is about such a drift";
  EXPECT_GT(of_turn, drift / 2);
  EXPECT_LT(of_turn, 100 * drift);
  const auto [add, of_add] = estimate("./add.toml");
  const double error = std::abs(number(add.at("state").at("x")) - (1 + 1e7 / 3)) / (1e7 / 3);
  EXPECT_GT(error, 1e-11) << "the test is about such an error";
  EXPECT_GT(of_add, error / 2);
  EXPECT_LT(of_add, 100 * error);
}

TEST(MapOrbits, AnOrbitOfPeriodTwoDoesNotHideAChange) {
  const Folder folder;
  folder.write("two.toml",
               "[phase_space]\nvariables = [\"x\"]\n[map]\nx = \"-x\"\n[integrals]\nX = \"x\"\n"
               "E = \"sqrt(x^2 - 2)\"\n"
               "[[scene]]\nname = \"default\"\ninitial = { x = \"1\" }\nduration = \"10000\"\n");
  const Json json = run_in(folder, {"integrate", "./two.toml", "--json"}).json();
  EXPECT_EQ(number(json.at("invariants").at("X").at("drift")), 2);
  // What has no value has not kept it.
  EXPECT_TRUE(std::isinf(number(json.at("invariants").at("E").at("drift"))));
}

// Lyness' map keeps the first term; beside it the rest is no drift.
TEST(MapOrbits, ASmallChangeBesideALargeValueIsSeen) {
  const auto lyness = [](const std::string& more) {
    return "[phase_space]\nvariables = [\"x\", \"y\"]\n[map]\nx = \"y\"\ny = \"(1 + y)/x\"\n"
           "[integrals]\nG = \"(1 + x)*(1 + y)*(1 + x + y)/(x*y)" +
           more +
           "\"\n[[scene]]\nname = \"default\"\ninitial = { x = \"1\", y = \"2\" }\n"
           "duration = \"12\"\n";
  };
  const Folder folder;
  folder.write("kept.toml", lyness(""));
  EXPECT_EQ(run_in(folder, {"conserve", "./kept.toml"}).status, 0);
  for (const char* more : {" + x/10^11", " + 10^20 + x"}) {
    folder.write("other.toml", lyness(more));
    const Outcome outcome = run_in(folder, {"conserve", "./other.toml"});
    EXPECT_EQ(outcome.status, 1) << more;
    EXPECT_TRUE(has(outcome.out, "G is not kept")) << outcome.out;
  }
}

// Within the steps 1 - cos(y) loses its digits, and (1 - cos(y))/y^2 tends to 1/2.
TEST(MapOrbits, WhatCancelsInAStepIsSeen) {
  const Folder folder;
  std::ofstream(folder.path() / "cancels.toml") << R"toml(title = "cancels"
[phase_space]
variables = ["x", "y"]
[map]
x = "(1 - cos(y))/y^2"
y = "y/10"
[[scene]]
name = "default"
initial = { x = "1/2", y = "1/10" }
duration = "9"
)toml";
  for (const int steps : {2, 5, 9}) {
    const Json json = run_in(folder, {"integrate", "./cancels.toml", "--duration",
                                      std::to_string(steps), "--json"})
                          .json();
    const double y = std::pow(10., -steps);  // of the step before, with x up to y^4/720
    const double error =
        std::abs(std::stod(json.at("state").at("x").get<std::string>()) - (0.5 - y * y / 24));
    EXPECT_GT(json.at("trust").at("error_estimate"), error / 10) << steps;
  }
}

/// x y is 0 all along the orbit: nothing of it is rounded.
TEST(MapOrbits, AnIntegralWithoutAValueSaysNothingOfThem) {
  const Folder folder;
  folder.write("turn.toml", R"toml(title = "turn"
[phase_space]
variables = ["x", "y"]
[map]
x = "-y"
y = "x"
[integrals]
F = "(x^2 - y^2)^2/(x*y)^2"
[[scene]]
name = "default"
initial = { x = "2", y = "0" }
duration = "10"
)toml");
  const std::string warnings =
      run_in(folder, {"integrate", "./turn.toml", "--json"}).json().at("warnings").dump();
  EXPECT_TRUE(has(warnings, "F has no value at some state of the run")) << warnings;
  EXPECT_FALSE(has(warnings, "rounding")) << warnings;
  const Outcome kept = run_in(folder, {"conserve", "./turn.toml"});
  EXPECT_EQ(kept.status, 1);
  EXPECT_TRUE(has(kept.out, "F has no value at some state, and cannot be watched")) << kept.out;
}

}  // namespace
}  // namespace casimir::test
