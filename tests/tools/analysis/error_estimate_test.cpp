// How far an end state can be believed.
#include "tools/analysis/estimate/error_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/analysis/systems.hpp"
#include "tools/analysis/estimate/growth_of_changes.hpp"
#include "tools/analysis/solve.hpp"

namespace casimir::test {
namespace {

TEST(ErrorEstimate, TheEstimateIsAboveTheErrorAndNotFarAbove) {
  const Oscillator oscillator;
  for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
    SolveOptions options;
    options.method = "dop853";
    options.run.tolerance = tolerance;
    const Solution motion = solve(oscillator.model, oscillator.scene(100), options);
    ASSERT_TRUE(motion.ok());
    const ErrorEstimate& trust = motion.trust();
    ASSERT_TRUE(trust.known);
    const double error = std::hypot(motion.trajectory().state[0] - std::cos(100.),
                                    motion.trajectory().state[1] + std::sin(100.));
    EXPECT_GE(trust.error_estimate, error / 2) << tolerance;
    EXPECT_LE(trust.error_estimate, 100 * error + 1e-14) << tolerance;
    EXPECT_FALSE(trust.beyond_double);
    EXPECT_FALSE(trust.unconfirmed);
  }
}

TEST(ErrorEstimate, GrowthOfChangesIsThatOfTheFlow) {
  // In units of the state when the change is made: what grows no faster than x = e^t itself is
  // lost in no digit, to the end of all doubles.
  for (const char* duration : {"10", "300", "700"}) {
    const Model growing = one_equation("x", duration);
    const Solution growth = solve(growing, growing.scene("default"));
    EXPECT_LT(growth.trust().conditioning, 10) << duration;
    EXPECT_FALSE(growth.trust().beyond_double) << duration;
    const double end = std::exp(std::stod(duration));
    EXPECT_NEAR(growth.trajectory().state[0] / end, 1, 1e-12) << duration;
    const double error = std::abs(growth.trajectory().state[0] / end - 1);
    EXPECT_GT(growth.trust().error_estimate, error / 3) << duration;
    EXPECT_LT(growth.trust().error_estimate, 1e-12) << duration;
  }
  // Away from x = 1, which the motion does not leave: a change grows e^10 times.
  const Model unstable = one_equation("x - 1", "10");
  const Solution motion = solve(unstable, unstable.scene("default"));
  ASSERT_TRUE(motion.trust().known);
  EXPECT_NEAR(motion.trust().conditioning / std::exp(10), 1, 0.01);
  EXPECT_FALSE(motion.trust().beyond_double);
  const Model lost = one_equation("x - 1", "40");
  const ErrorEstimate none = solve(lost, lost.scene("default")).trust();
  EXPECT_TRUE(none.beyond_double);
  EXPECT_NEAR(none.conditioning / std::exp(40), 1, 0.01);  // no step is long because nothing moves
  ASSERT_TRUE(none.six_digits_until);
  const Model overflowing = one_equation("x - 1", "800");
  const ErrorEstimate most = solve(overflowing, overflowing.scene("default")).trust();
  EXPECT_TRUE(most.known);
  EXPECT_TRUE(most.beyond_double);
  // Rounding grows to 1e-6 at the time log(1e-6 / 2^-53): the end of a step before it.
  EXPECT_LE(*none.six_digits_until, std::log(1e-6 * 0x1p53));
}

TEST(ErrorEstimate, RoundingOfTheDataIsCounted) {
  const Oscillator oscillator;
  const auto input = [&](const GiNaC::ex& q) {
    return solve(oscillator.model, scene_from(oscillator.model, {q, 0}, 10)).trust().input_rounding;
  };
  EXPECT_EQ(input(GiNaC::numeric(1, 2)), 0);
  EXPECT_GT(input(GiNaC::numeric(1, 3)), 1e-18);
  EXPECT_LT(input(GiNaC::numeric(1, 3)), 1e-15);
}

/// x' = 2 (1 - cos(t/10^8)) 10^16 is t^2, and 0 or 2.2 in double precision, whatever the method.
TEST(ErrorEstimate, DigitsThatTheEquationsLoseAreCounted) {
  for (const char* method : {"dop853", "gauss8", "radau5"}) {
    const Model cancels = driven_equation("2*(1 - cos(t/10^8))*10^16");
    SolveOptions options;
    options.method = method;
    options.run.tolerance = 1e-8;
    const Solution motion = solve(cancels, cancels.scene("default"), options);
    ASSERT_TRUE(motion.ok()) << method;
    const double error = std::abs(motion.trajectory().state[0] / (64. / 3) - 1);
    EXPECT_GT(error, 1e-6) << method;
    EXPECT_GT(motion.trust().error_estimate, error / 3) << method;
  }
  // The twin keeps all of them.
  const Model keeps = driven_equation("4*10^16*sin(t/(2*10^8))^2");
  const Solution motion = solve(keeps, keeps.scene("default"));
  EXPECT_NEAR(motion.trajectory().state[0] / (64. / 3), 1, 1e-14);
  EXPECT_LT(motion.trust().error_estimate, 1e-13);
}

TEST(ErrorEstimate, ChangesThatDiedOutAreToldFromThoseThatAreThere) {
  ErrorEstimate trust;
  trust.conditioning = 1;
  EXPECT_FALSE(trust.died_out());
  trust.beyond_double = true;
  EXPECT_TRUE(trust.died_out());
  trust.conditioning = 1e14;
  EXPECT_FALSE(trust.died_out());
}

TEST(ErrorEstimate, NothingIsSaidOfARunThatStopped) {
  const Model model = one_equation("x^2", "2");
  EXPECT_FALSE(solve(model, model.scene("default")).trust().known);
}

TEST(Conditioning, TheTimeOfAGrowthIsTheLastBeforeIt) {
  Conditioning flow;
  flow.growth = {{0, 1}, {1, 4}, {2, 64}};
  EXPECT_EQ(flow.time_of(1), 0);
  EXPECT_EQ(flow.time_of(3), 0);
  EXPECT_EQ(flow.time_of(5), 1);
  EXPECT_FALSE(flow.time_of(65));
  EXPECT_EQ(flow.on_the_way(), 64);
}

}  // namespace
}  // namespace casimir::test
