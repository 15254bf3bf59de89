// Enclosures of the derivatives of states by their start, against derivatives that are known
// otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "runtime/precise_run.hpp"
#include "runtime/validated/flow_map.hpp"
#include "tests/codegen/run/random_systems.hpp"

namespace casimir {
namespace {

using test::Builder;
using test::integral;
using test::problem_of;
using test::RandomSystem;

bool inside(const RationalInterval& interval, const cln::cl_RA& truth, double slack = 0) {
  const cln::cl_RA by = cln::rational(cln::cl_DF(slack));
  return interval.low - by <= truth && truth <= interval.high + by;
}

double width(const RationalInterval& interval) {
  return cln::double_approx(interval.high - interval.low);
}

ValidatedRun with_derivatives(const ValidatedProblem& problem, ValidatedSettings settings = {}) {
  settings.derivatives = true;
  return validated_run(problem, settings);
}

/// dx/dt = x^2 from x_0: x_0 / (1 - x_0 t), whose derivative is 1 / (1 - x_0 t)^2.
Program riccati() {
  Builder b({"x"});
  b.output(b.op(Op::mul, 0, 0));
  return b.program();
}

TEST(ValidatedDerivatives, OfASolutionThatGrowsBeyondAllBounds) {
  for (const int digits : {0, 30}) {
    ValidatedSettings settings;
    settings.digits = digits;
    const ValidatedRun run =
        with_derivatives(problem_of(riccati(), {1, cln::cl_RA(9) / 10}), settings);
    ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
    ASSERT_EQ(run.derivatives.size(), 1U);
    EXPECT_TRUE(inside(run.derivatives[0], 100));
    EXPECT_LT(width(run.derivatives[0]), digits == 0 ? 1e-9 : 1e-25);
  }
}

TEST(ValidatedDerivatives, HoldForEveryStartOfABoxForwardsAndBackwards) {
  for (const int digits : {0, 20}) {
    for (const cln::cl_RA& t : {cln::cl_RA(1) / 2, cln::cl_RA(-3)}) {
      ValidatedProblem problem = problem_of(riccati(), {1, t});
      const cln::cl_RA radius = cln::cl_RA(1) / 1000;
      problem.radii = {radius};
      ValidatedSettings settings;
      settings.digits = digits;
      const ValidatedRun run = with_derivatives(problem, settings);
      ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
      for (const cln::cl_RA& x : {1 - radius, cln::cl_RA(1), 1 + radius})
        EXPECT_TRUE(inside(run.derivatives[0], 1 / ((1 - x * t) * (1 - x * t))));
      EXPECT_LT(width(run.derivatives[0]), 0.2);
    }
  }
}

/// dx/dt = a y, dy/dt = -x / a: the angle turns by t, and the derivatives are cos t, a sin t,
/// -sin t / a, cos t.
Program ellipse(const cln::cl_RA& a) {
  Builder b({"x", "y"});
  b.output(b.op(Op::mul, b.number(a), 1));
  b.output(b.op(Op::neg, b.op(Op::div, 0, b.number(a))));
  return b.program();
}

TEST(ValidatedDerivatives, OfStatesOfDifferentSizesAreNotSpoiled) {
  const cln::cl_RA a = cln::expt(cln::cl_RA(10), 6);
  for (const bool contract : {false, true}) {
    ValidatedProblem problem = problem_of(ellipse(a), {1, 0, 10});
    if (contract) {
      Builder b({"x", "y"});
      b.output(
          b.op(Op::add, b.op(Op::mul, 0, 0), b.op(Op::mul, b.number(a * a), b.op(Op::mul, 1, 1))));
      problem.integrals = {integral("size", b.program(), 2)};
    }
    const ValidatedRun run = with_derivatives(problem);
    ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
    const double c = std::cos(10.), s = std::sin(10.), size[] = {1, 1e6, 1e-6, 1};
    const double truth[] = {c, 1e6 * s, -1e-6 * s, c};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_TRUE(inside(run.derivatives[i], cln::rational(cln::cl_DF(truth[i])),
                         1e-15 * std::abs(truth[i])));
      EXPECT_LT(width(run.derivatives[i]), 1e-11 * size[i]) << i;
    }
  }
}

// --- random systems

/// The states at the end of a run from this start, to many digits.
std::vector<cln::cl_RA> ends_from(const Program& rates, const std::vector<cln::cl_RA>& start) {
  PreciseProblem problem;
  problem.rhs = &rates;
  problem.start = [&](int) { return std::vector<cln::cl_R>(start.begin(), start.end()); };
  problem.max_steps = 1000;
  problem.sample_every = cln::abs(start.back());
  const PreciseRun run = precise_run(problem, 48);
  std::vector<cln::cl_RA> end;
  if (run.status != Status::ok || run.samples.empty()) return end;
  for (const cln::cl_R& x : run.samples.back()) end.push_back(cln::rational(x));
  return end;
}

struct Counts {
  int enclosed = 0, compared = 0, missed = 0;
};

/// Differences over 1e-16 to both sides: off by 1e-32 of the third derivative, and 1e-32 of
/// rounding.
void compare(const Program& rates, const ValidatedRun& run, const std::vector<cln::cl_RA>& start,
             Counts& counts) {
  const std::size_t n = rates.outputs.size();
  const cln::cl_RA by = cln::expt(cln::cl_RA(10), -16);
  bool missed = false;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<cln::cl_RA> above = start, below = start;
    above[j] = above[j] + by;
    below[j] = below[j] - by;
    const std::vector<cln::cl_RA> up = ends_from(rates, above), down = ends_from(rates, below);
    if (up.size() != n || down.size() != n) return;
    for (std::size_t i = 0; i < n; ++i) {
      const cln::cl_RA slope = (up[i] - down[i]) / (2 * by);
      const double slack = 1e-24 * (1 + std::abs(cln::double_approx(slope)));
      missed |= !inside(run.derivatives[i * n + j], slope, slack);
    }
  }
  ++counts.compared;
  counts.missed += missed ? 1 : 0;
}

Counts random_trials(int trials, bool with_boxes, const ValidatedSettings& settings) {
  Counts counts;
  RandomSystem random(with_boxes ? 3 : 11);
  for (int trial = 0; trial < trials; ++trial) {
    const Program rates = random.program();
    const std::size_t n = rates.outputs.size();
    std::vector<cln::cl_RA> start;
    for (std::size_t i = 0; i < n; ++i) start.push_back(random.number(1));
    start.push_back(cln::cl_RA(random.whole(1, 9)) / 13 * (random.whole(0, 3) == 0 ? -1 : 1));
    ValidatedProblem problem = problem_of(rates, start);
    const cln::cl_RA radius = cln::expt(cln::cl_RA(10), -random.whole(2, 13));
    if (with_boxes) problem.radii.assign(n, radius);
    ValidatedSettings how = settings;
    how.max_steps = 2000;
    const ValidatedRun run = with_derivatives(problem, how);
    if (run.status != ValidatedStatus::ok) continue;
    ++counts.enclosed;
    for (std::size_t i = 0; with_boxes && i < n; ++i)
      start[i] = start[i] + radius * random.whole(0, 1) * 2 - radius;
    compare(rates, run, start, counts);
  }
  return counts;
}

void expect_right(const Counts& counts, int least) {
  EXPECT_EQ(counts.missed, 0);
  EXPECT_GT(counts.compared, least);
  EXPECT_GT(10 * counts.compared, 9 * counts.enclosed);
}

/// How many systems: few, or a tenth of what CASIMIR_VALIDATED_TRIALS says.
int trials() {
  const char* const asked = std::getenv("CASIMIR_VALIDATED_TRIALS");
  return asked ? std::atoi(asked) / 10 : 25;
}

TEST(ValidatedDerivatives, OfRandomSystemsContainQuotientsOfDifferences) {
  expect_right(random_trials(trials(), false, {}), trials() / 2);
  expect_right(random_trials(trials(), true, {}), trials() / 2);
  ValidatedSettings precise;
  precise.digits = 20;
  expect_right(random_trials(trials() / 4, true, precise), trials() / 8);
}

// With a tolerance at which the remainder matters: without it derivatives are missed.
TEST(ValidatedDerivatives, MissWithoutTheRemainder) {
  ValidatedSettings coarse;
  coarse.order = 6;
  coarse.log2_error = -24;
  expect_right(random_trials(25, false, coarse), 12);
  coarse.without_remainder = true;
  EXPECT_GT(random_trials(25, false, coarse).missed, 5);
}

// --- the flow to a time of an interval

TEST(FlowMap, ContainsTheSolutionsAndTheirDerivativesAtEveryTime) {
  const ValidatedProblem problem = problem_of(riccati(), {1, 1});
  const validated::FlowProgram flow =
      validated::joined(problem.rates, problem.jacobian, problem.entries);
  const std::vector<validated::Integral> none;
  validated::FlowMap map(flow, none, {});
  const validated::MidRad time(0.5, 0x1p-20);
  ASSERT_TRUE(map.find({validated::ArbBall(1.)}, {validated::MidRad(0, 0x1p-20)}, time, true))
      << map.reason();
  const validated::FlowImage& image = map.result();
  for (const double x : {1 - 0x1p-20, 1., 1 + 0x1p-20}) {
    for (const double t : {0.5 - 0x1p-20, 0.5, 0.5 + 0x1p-20}) {
      const double end = x / (1 - x * t), slack = 1e-14;
      EXPECT_LE(std::abs(end - image.states[0].mid), image.states[0].rad + slack);
      EXPECT_LE(std::abs(end * end / x / x - image.derivatives(0, 0).mid),
                image.derivatives(0, 0).rad + slack);
      EXPECT_LE(std::abs(end * end - image.rates[0].mid), image.rates[0].rad + slack);
    }
  }
  EXPECT_LT(image.states[0].rad, 2e-5);
  EXPECT_LT(image.derivatives(0, 0).rad, 1e-4);
  // The pole is at 1 for this start; a time below zero is none.
  EXPECT_FALSE(map.find({validated::ArbBall(1.)}, {validated::MidRad()}, {1, 0x1p-20}, true));
  EXPECT_FALSE(map.find({validated::ArbBall(1.)}, {validated::MidRad()}, {0, 0x1p-20}, true));
}

}  // namespace
}  // namespace casimir
