#include "runtime/step/step_poles.hpp"

#include <cln/rational.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "runtime/uncompiled.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir::test {
namespace {

/// A step of length 1 along a straight line.
struct StraightStep {
  std::vector<double> from, to;

  casimir_step seen() const {
    return {0, 1, from.data(), to.data(), &state_at, this, nullptr, nullptr};
  }
  static void state_at(const casimir_step* step, double t, double* x) {
    const auto& [from, to] = *static_cast<const StraightStep*>(step->data);
    for (std::size_t i = 0; i < from.size(); ++i) x[i] = from[i] + t * (to[i] - from[i]);
  }
};

std::optional<double> pole_in(const Program& rhs, const StraightStep& step) {
  const StepWatch watch(rhs);
  StepPoles poles(watch, step.from.size());
  poles.begin(nullptr);
  const auto arguments = [&](const std::vector<double>& x, double t) {
    std::vector<double> inputs = x, values(watch.arguments().outputs.size());
    inputs.push_back(t);
    Interpreter(watch.arguments())(inputs.data(), values.data());
    return values;
  };
  const std::vector<double> first = arguments(step.from, 0), last = arguments(step.to, 1);
  if (!poles.may_lie_between(first.data(), last.data())) return std::nullopt;
  return poles.first_in(step.seen(), first.data(), last.data());
}

/// x' = 1, y' = N/x^n with a numerator made from the lines of x and y.
template <class Numerator>
Program quotient(const Numerator& numerator, int power = 1) {
  Builder lines({"x", "y"});
  lines.output(lines.number(1));
  int divisor = 0;
  for (int k = 1; k < power; ++k) divisor = lines.op(Op::mul, divisor, 0);
  lines.output(lines.op(Op::div, numerator(lines), divisor));
  return lines.program();
}

int one(Builder& lines) { return lines.number(1); }

TEST(StepPoles, OddOnesAreFoundWhereTheyAre) {
  for (const int power : {1, 3}) {
    const auto part = pole_in(quotient(one, power), {{-1, 0}, {3, 1}});
    ASSERT_TRUE(part) << power;
    EXPECT_NEAR(*part, 0.25, 1e-9) << power;
  }
  // Just behind the start, and just before the end.
  EXPECT_TRUE(pole_in(quotient(one), {{-1e-9, 0}, {1, 1}}));
  EXPECT_TRUE(pole_in(quotient(one), {{-1, 0}, {1e-9, 1}}));
  EXPECT_FALSE(pole_in(quotient(one), {{1, 0}, {2, 1}}));
}

TEST(StepPoles, EvenOnesAreNone) { EXPECT_FALSE(pole_in(quotient(one, 2), {{-1, 0}, {3, 1}})); }

TEST(StepPoles, QuotientsWithALimitHaveNone) {
  const auto sine = [](Builder& lines) { return lines.op(Op::sin, 0); };
  EXPECT_FALSE(pole_in(quotient(sine), {{-1, 0}, {3, 1}}));
  // Along the motion: y = x up to an error.
  const auto y = [](Builder&) { return 1; };
  EXPECT_FALSE(pole_in(quotient(y), {{-1, -1 + 1e-5}, {3, 3 + 1e-5}}));
  EXPECT_TRUE(pole_in(quotient(y), {{-1, 1}, {3, 2}}));
  // Switched off.
  const auto zero = [](Builder& lines) { return lines.op(Op::mul, lines.number(0), 1); };
  EXPECT_FALSE(pole_in(quotient(zero), {{-1, -1}, {3, 3}}));
}

TEST(StepPoles, BoundedFunctionsOfQuotientsHaveNone) {
  Builder lines({"x"});
  lines.output(lines.op(Op::tanh, lines.op(Op::div, lines.number(1), 0)));
  EXPECT_FALSE(pole_in(lines.program(), {{-1}, {3}}));
}

/// x' = 1/(1 - x)
Program drawn_to_one() {
  Builder lines({"x"});
  lines.output(lines.op(Op::div, lines.number(1), lines.op(Op::sub, lines.number(1), 0)));
  return lines.program();
}

Trajectory run_of(const Program& rhs, double tolerance, std::vector<double> start) {
  Settings settings;
  settings.duration = 2;
  settings.rtol = tolerance;
  settings.atol = tolerance / 100;
  settings.max_steps = 100000;
  return integrate(uncompiled_module(rhs, {}, std::nullopt, {}), *find_method("taylor"), settings,
                   start);
}

TEST(StepPoles, NoToleranceIsSoLooseThatARunGoesOn) {
  // x = 1 - sqrt(1 - 2t)
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const Trajectory run = run_of(drawn_to_one(), tolerance, {0});
    EXPECT_EQ(run.status, Status::singularity) << tolerance << ": " << run.reason;
    EXPECT_NEAR(run.time, 0.5, 10 * tolerance) << tolerance;
    // y = log|x| with x = t - 1: here series stop at the pole, and what passes kinks is to as well.
    const Trajectory logarithm = run_of(quotient(one), tolerance, {-1, 0});
    EXPECT_EQ(logarithm.status, Status::singularity) << tolerance << ": " << logarithm.reason;
    EXPECT_NEAR(logarithm.time, 1, 1e-10) << tolerance;
  }
}

TEST(StepPoles, RunsGoThroughQuotientsWithALimit) {
  const auto sine = [](Builder& lines) { return lines.op(Op::sin, 0); };
  for (const double tolerance : {1e-3, 1e-10}) {
    const Trajectory run = run_of(quotient(sine), tolerance, {-0.75, 0});
    ASSERT_EQ(run.status, Status::ok) << tolerance << ": " << run.reason;
    EXPECT_NEAR(run.state[1], 0.726954247150 + 1.146446415673, 10 * tolerance) << tolerance;
  }
}

}  // namespace
}  // namespace casimir::test
