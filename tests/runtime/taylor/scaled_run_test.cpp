// Runs by tables in units of the state: where the numbers of the caller end, the run does.
#include "runtime/taylor/scaled_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

/// x' = x y, y' = y: x = x(0) exp(y(0) (e^t - 1)), which is a number at all times, and beyond all
/// doubles after a while.
Trajectory run_double_exponential(double duration, double sample_every) {
  Builder lines({"x", "y"});
  lines.output(lines.op(Op::mul, 0, 1));
  lines.output(1);
  const QuadraticForm form{.states = 2,
                           .constant = {0, 0},
                           .linear = {{0, 0}, {0, 1}},
                           .products = {{0, 1, {1, 0}}},
                           .constant_rest = {},
                           .linear_rest = {}};
  const Module module = uncompiled_module(lines.program(), {}, form, {});
  Settings settings;
  settings.duration = duration;
  settings.rtol = settings.atol = 1e-12;
  settings.sample_every = sample_every;
  return integrate(module, *find_method("taylor"), settings, {1, 1});
}

TEST(ScaledRun, FollowsTheStateToTheEndOfDoubles) {
  const Trajectory far = run_double_exponential(6.5, 0);
  ASSERT_EQ(far.status, Status::ok);
  EXPECT_NEAR(std::log(far.state[0]), std::expm1(6.5), 1e-8);
}

// Divided by its unit the state is a number still: that is none of the caller's.
TEST(ScaledRun, EndsWithTheLastNumbersOfTheCaller) {
  for (const double every : {0., 0.01}) {
    const Trajectory beyond = run_double_exponential(6.6, every);
    EXPECT_EQ(beyond.status, Status::non_finite) << beyond.reason;
    EXPECT_LT(beyond.time, std::log1p(709.79));
    EXPECT_GT(beyond.time, 6.5);
    ASSERT_TRUE(std::isfinite(beyond.state[0]));
    EXPECT_NEAR(std::log(beyond.state[0]), std::expm1(beyond.time), 1e-8);
    for (const auto& sample : beyond.samples) EXPECT_TRUE(std::isfinite(sample[0]));
  }
}

}  // namespace
}  // namespace casimir::test
