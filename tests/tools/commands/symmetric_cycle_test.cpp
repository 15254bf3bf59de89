// casimir section --symmetry: what is no symmetry, no cycle, or not told apart from another one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace casimir::test {
namespace {

class SymmetricCycle : public testing::Test {
 protected:
  /// Of a canonical system of two or three degrees of freedom, with the symmetry that exchanges the
  /// first two.
  Outcome exchanged(const std::string& hamiltonian, const std::string& initial,
                    const std::string& duration, std::vector<std::string> more = {}) {
    const bool third = has(hamiltonian, "p3");
    folder_.write("case.toml", fmt::format(R"toml(
title = "pair"
hamiltonian = "{}"
[phase_space]
variables = [{}]
canonical = true
[[scene]]
name = "default"
initial = {{ {} }}
duration = "{}"
)toml",
                                           hamiltonian,
                                           third ? R"("q1", "q2", "q3", "p1", "p2", "p3")"
                                                 : R"("q1", "q2", "p1", "p2")",
                                           initial, duration));
    std::vector<std::string> arguments{"section",    "./case.toml", "--symmetry", "q1=q2",
                                       "--symmetry", "q2=q1",       "--symmetry", "p1=p2",
                                       "--symmetry", "p2=p1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_in(folder_, arguments);
  }

  const Folder folder_;
};

const char* const kApart = R"(q1 = "1", q2 = "-1", q3 = "0", p1 = "0", p2 = "0", p3 = "0")";

TEST_F(SymmetricCycle, OfAMapThatIsNoSymmetryIsRefused) {
  // Slow, so that all rates are small; the same within the region of any few points; almost.
  for (const char* hamiltonian :
       {"(p1^2 + p2^2 + p3^2)/2 + ((q1^2 + q2^2)/2 + (1/4 + q1)*q3^2/2)/10^10",
        "(p1^2 + p2^2 + p3^2)/2 + (q1^2 + q2^2)/2 + (1 - (sqrt(q1^2) - q1))*q3^2/2",
        "(p1^2 + p2^2 + p3^2)/2 + (q1^2 + q2^2 + q3^2)/2 + q1^20/10^12"}) {
    const Outcome outcome = exchanged(hamiltonian, kApart, "6.283185307179586");
    EXPECT_EQ(outcome.status, 2) << hamiltonian << outcome.out;
    EXPECT_TRUE(has(outcome.err, "the map is no symmetry of the equations")) << outcome.err;
  }
}

TEST_F(SymmetricCycle, ThatIsAnEquilibriumHasNoPeriod) {
  const Outcome outcome = exchanged("(p1^2 + p2^2)/2 + (q1^2 - 1)^2 + (q2^2 - 1)^2 + q1*q2/10",
                                    R"(q1 = "0.97", q2 = "0.97", p1 = "0.01", p2 = "0")", "5");
  EXPECT_NE(outcome.status, 0) << outcome.out;
  EXPECT_TRUE(has(outcome.err, "an equilibrium, which has no period")) << outcome.err;
}

/// Far from the origin, and beside a variable that does not move.
TEST_F(SymmetricCycle, MayBeSmallBesideItsPlace) {
  const Outcome far = exchanged("(p1^2 + p2^2)/2 + ((q1 - 10^8)^2 + (q2 - 10^8)^2)/2",
                                R"(q1 = "10^8 + 1", q2 = "10^8 - 1", p1 = "0", p2 = "0")", "6.3");
  EXPECT_EQ(far.status, 0) << far.err;
  folder_.write("case.toml", R"toml(
title = "a Casimir function in other units"
hamiltonian = "(p1^2 + p2^2 + q1^2 + q2^2)/2 + (q1^4 + q2^4)*c/(4*10^10)"
[phase_space]
variables = ["q1", "q2", "p1", "p2", "c"]
[phase_space.brackets]
"q1,p1" = "1"
"q2,p2" = "1"
[[scene]]
name = "default"
initial = { q1 = "1", q2 = "-1", p1 = "0", p2 = "0", c = "10^10" }
duration = "4.8"
)toml");
  const Outcome beside =
      run_in(folder_, {"section", "./case.toml", "--symmetry", "q1=q2", "--symmetry", "q2=q1",
                       "--symmetry", "p1=p2", "--symmetry", "p2=p1"});
  EXPECT_EQ(beside.status, 0) << beside.err;
}

TEST_F(SymmetricCycle, ThatTheSymmetryLeavesAloneHasAShorterPeriod) {
  const Outcome outcome = exchanged("(p1^2 + p2^2 + q1^2 + q2^2)/2 + (q1^4 + q2^4)/4",
                                    R"(q1 = "1", q2 = "1", p1 = "0", p2 = "0")", "9.5");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "1/2 of T is a period of it already")) << outcome.out;
}

// r' = c r (r^2 - 1): the multiplier over half of the period is exp(2 Pi c).
TEST_F(SymmetricCycle, OfAFlowWithoutABracketNeedNotBeOnTheUnitCircle) {
  const auto stability = [&](const std::string& c) {
    folder_.write("case.toml", fmt::format(R"toml(
title = "cycle"
[phase_space]
variables = ["x", "y"]
[equations]
x = "-y + {0}*x*(x^2 + y^2 - 1)"
y = "x + {0}*y*(x^2 + y^2 - 1)"
[section]
function = "y"
plot = ["x", "y"]
[[scene]]
name = "default"
initial = {{ x = "1", y = "1/1000" }}
duration = "62/10"
)toml",
                                           c));
    const Outcome outcome = run_in(
        folder_, {"section", "./case.toml", "--symmetry", "x=-x", "--symmetry", "y=-y", "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("stable");
  };
  EXPECT_EQ(stability("10^(-6)"), nullptr);
  EXPECT_EQ(stability("1/10"), false);
  EXPECT_EQ(stability("(-1/10)"), true);
}

TEST_F(SymmetricCycle, OptionsThatAreNotUsedAreRefused) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--energy", "50"}, {"--fixed-points"}, {"--orbits", "3"}})
    EXPECT_EQ(exchanged("(p1^2 + p2^2 + q1^2 + q2^2)/2 + (q1^4 + q2^4)/4",
                        R"(q1 = "1", q2 = "1", p1 = "0", p2 = "0")", "9.5", more)
                  .status,
              2)
        << more.front();
}

}  // namespace
}  // namespace casimir::test
