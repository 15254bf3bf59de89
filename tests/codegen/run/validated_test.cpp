// Boxes that are said to contain solutions, against solutions that are known otherwise.
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "runtime/precise_run.hpp"
#include "tests/codegen/run/random_systems.hpp"

namespace casimir {
namespace {

using test::Builder;
using test::integral;
using test::problem_of;
using test::RandomSystem;

bool inside(const RationalInterval& box, const cln::cl_RA& truth, double slack = 0) {
  const cln::cl_RA by = cln::rational(cln::cl_DF(slack));
  return box.low - by <= truth && truth <= box.high + by;
}

double width(const RationalInterval& box) { return cln::double_approx(box.high - box.low); }

// --- closed forms

/// dx/dt = x^2 from 1: 1 / (1 - t).
Program riccati() {
  Builder b({"x"});
  b.output(b.op(Op::mul, 0, 0));
  return b.program();
}

TEST(Validated, EnclosesASolutionThatGrowsBeyondAllBoundsUpToItsPole) {
  for (const int digits : {0, 30}) {
    ValidatedSettings settings;
    settings.digits = digits;
    const ValidatedRun before =
        validated_run(problem_of(riccati(), {1, cln::cl_RA(9) / 10}), settings);
    ASSERT_EQ(before.status, ValidatedStatus::ok) << before.reason;
    EXPECT_TRUE(inside(before.end.states[0], 10));
    EXPECT_LT(width(before.end.states[0]), digits == 0 ? 1e-12 : 1e-28);
    EXPECT_EQ(before.end.time, cln::cl_RA(9) / 10);

    const ValidatedRun beyond = validated_run(problem_of(riccati(), {1, 2}), settings);
    EXPECT_EQ(beyond.status, ValidatedStatus::no_enclosure);
    EXPECT_LT(beyond.end.time, 1);
    EXPECT_GT(beyond.end.time, cln::cl_RA(99) / 100);
    EXPECT_TRUE(inside(beyond.end.states[0], 1 / (1 - beyond.end.time)));
  }
}

TEST(Validated, EnclosesBackwardsInTime) {
  const ValidatedRun run = validated_run(problem_of(riccati(), {1, -4}), {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  EXPECT_EQ(run.end.time, -4);
  EXPECT_TRUE(inside(run.end.states[0], cln::cl_RA(1) / 5));
  EXPECT_LT(width(run.end.states[0]), 1e-14);
}

TEST(Validated, BoxesBetweenStepsContainTheSolutionAtExactlyTheirTimes) {
  ValidatedSettings settings;
  settings.sample_every = cln::cl_RA(1) / 7;  // no double
  const cln::cl_RA end = cln::cl_RA(10) / 3;
  const ValidatedRun run = validated_run(problem_of(riccati(), {-1, end}), settings);
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  ASSERT_EQ(run.samples.size(), 25U);
  for (std::size_t k = 0; k < run.samples.size(); ++k) {
    const StateBox& box = run.samples[k];
    EXPECT_EQ(box.time, k + 1 < run.samples.size() ? settings.sample_every * cln::cl_I(k) : end);
    EXPECT_TRUE(inside(box.states[0], -1 / (1 + box.time)));
    EXPECT_LT(width(box.states[0]), 1e-14);
  }
}

TEST(Validated, EquationsThatDependOnTheTime) {
  // dx/dt = 1 / (1 + t)^2 from 0: t / (1 + t); forwards and backwards.
  Builder b({"x"});
  const int sum = b.op(Op::add, b.number(1), b.time());
  b.output(b.op(Op::div, b.number(1), b.op(Op::mul, sum, sum)));
  for (const cln::cl_RA& t : {cln::cl_RA(7) / 3, cln::cl_RA(-1) / 3}) {
    const ValidatedRun run = validated_run(problem_of(b.program(), {0, t}), {});
    ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
    EXPECT_TRUE(inside(run.end.states[0], t / (1 + t)));
    EXPECT_LT(width(run.end.states[0]), 1e-14);
  }
  // .. where the rate has a pole at the time 1 that the states do not see
  Builder pole({"x"});
  const int left = pole.op(Op::sub, pole.number(1), pole.time());
  pole.output(pole.op(Op::div, pole.number(1), pole.op(Op::mul, left, left)));
  const ValidatedRun run = validated_run(problem_of(pole.program(), {0, 2}), {});
  EXPECT_EQ(run.status, ValidatedStatus::no_enclosure);
  EXPECT_LT(run.end.time, 1);
}

TEST(Validated, RefusesWhereABranchIsNotCertain) {
  const auto ends_at = [](const Program& rates, const cln::cl_RA& start) {
    const ValidatedRun run = validated_run(problem_of(rates, {start, 10}), {});
    EXPECT_EQ(run.status, ValidatedStatus::no_enclosure);
    return cln::double_approx(run.end.time);
  };
  {  // dx/dt = -sqrt(x) from 1 is at rest from t = 2 on, or not: it is not unique backwards
    Builder b({"x"});
    b.output(b.op(Op::neg, b.op(Op::sqrt, 0)));
    const double t = ends_at(b.program(), 1);
    EXPECT_LE(t, 2);
    EXPECT_GT(t, 1.9);
  }
  {  // dx/dt = -1 - |x| passes the corner of |.| at t = log 2
    Builder b({"x"});
    b.output(b.op(Op::sub, b.number(-1), b.op(Op::abs, 0)));
    const double t = ends_at(b.program(), 1);
    EXPECT_LE(t, 0.693147180559946);
    EXPECT_GT(t, 0.69);
  }
  {  // the angle of (-1, x), which jumps where x passes zero
    Builder b({"x"});
    b.output(b.op(Op::neg, b.op(Op::atan2, 0, b.number(-1))));
    EXPECT_LE(ends_at(b.program(), 1), 1);
  }
  {  // at the start already: the root of zero
    Builder b({"x"});
    b.output(b.op(Op::sqrt, 0));
    EXPECT_EQ(ends_at(b.program(), 0), 0);
  }
}

TEST(Validated, AProblemWithoutAStartForEachStateIsRefused) {
  EXPECT_THROW(validated_run(problem_of(riccati(), {5}), {}), std::invalid_argument);
  ValidatedProblem problem = problem_of(riccati(), {1, 5});
  problem.radii = {1, 1};
  EXPECT_THROW(validated_run(problem, {}), std::invalid_argument);
}

TEST(Validated, AStateAtRestStaysThere) {
  const ValidatedRun run = validated_run(problem_of(riccati(), {0, 5}), {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  EXPECT_TRUE(inside(run.end.states[0], 0));
  EXPECT_LT(width(run.end.states[0]), 1e-100);
}

/// dx/dt = y, dy/dt = -x, with x^2 + y^2.
Program rotation() {
  Builder b({"x", "y"});
  b.output(1);
  b.output(b.op(Op::neg, 0));
  return b.program();
}
KnownIntegral circle() {
  Builder b({"x", "y"});
  b.output(b.op(Op::add, b.op(Op::mul, 0, 0), b.op(Op::mul, 1, 1)));
  return integral("circle", b.program(), 2);
}

TEST(Validated, AnIntegralMakesTheBoxSmaller) {
  ValidatedProblem problem = problem_of(rotation(), {3, 4, 100});
  const ValidatedRun alone = validated_run(problem, {});
  problem.integrals = {circle()};
  const ValidatedRun with = validated_run(problem, {});
  ASSERT_EQ(alone.status, ValidatedStatus::ok);
  ASSERT_EQ(with.status, ValidatedStatus::ok);
  EXPECT_EQ(with.contracted_by, std::vector<std::string>{"circle"});
  EXPECT_TRUE(alone.contracted_by.empty());
  // The way along the circle is as uncertain as it was.
  const auto area = [](const ValidatedRun& run) {
    return width(run.end.states[0]) * width(run.end.states[1]);
  };
  EXPECT_LT(area(with), area(alone));
}

TEST(Validated, AFunctionThatChangesIsFoundOutOrMissesTheTruth) {
  // What the caller calls an integral is believed: it has to be proved. x is none here.
  Builder b({"x", "y"});
  b.output(0);
  ValidatedProblem problem = problem_of(rotation(), {3, 4, 1});
  problem.integrals = {integral("x", b.program(), 2)};
  EXPECT_EQ(validated_run(problem, {}).status, ValidatedStatus::contradiction);
}

TEST(Validated, AnAngleIsNoIntegralBeyondItsCut) {
  // dx/dt = y, dy/dt = -x, dz/dt = 1: z + atan2(y, x) is constant but where the angle jumps.
  Builder b({"x", "y", "z"});
  b.output(1);
  b.output(b.op(Op::neg, 0));
  b.output(b.number(1));
  Builder value({"x", "y", "z"});
  value.output(value.op(Op::add, 2, value.op(Op::atan2, 1, 0)));
  ValidatedProblem problem = problem_of(b.program(), {1, 0, 0, 20});
  problem.integrals = {integral("phase", value.program(), 3), circle()};
  problem.integrals[1] = [] {
    Builder c({"x", "y", "z"});
    c.output(c.op(Op::add, c.op(Op::mul, 0, 0), c.op(Op::mul, 1, 1)));
    return integral("circle", c.program(), 3);
  }();
  const ValidatedRun run = validated_run(problem, {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  EXPECT_TRUE(inside(run.end.states[2], 20));
  // cos 20
  EXPECT_TRUE(inside(run.end.states[0], cln::cl_RA(cln::rational(
                                            cln::cos(cln::cl_float(20, cln::float_format(40)))))));
}

// --- random systems

struct Counts {
  int enclosed = 0, refused = 0, compared = 0, missed = 0, unconfirmed = 0;
};

/// Compares the boxes of a run with the states of a solution to sixty digits, in balls of Arb's of
/// 200 bits and more, from a start within the box of starts.
void compare(const ValidatedProblem& problem, const ValidatedRun& run,
             const std::vector<cln::cl_RA>& start, const cln::cl_RA& every, Counts& counts) {
  PreciseProblem truth;
  truth.rhs = &problem.rates;
  truth.start = [&](int) { return std::vector<cln::cl_R>(start.begin(), start.end()); };
  truth.sample_every = every;
  truth.max_steps = 1000;
  const PreciseRun precise = precise_run(truth, 60);
  if (precise.status != Status::ok || precise.samples.size() != run.samples.size()) {
    ++counts.unconfirmed;
    return;
  }
  ++counts.compared;
  bool missed = false;
  for (std::size_t k = 0; k < run.samples.size(); ++k) {
    for (std::size_t i = 0; i < run.samples[k].states.size(); ++i) {
      const cln::cl_RA x = cln::rational(precise.samples[k][i]);
      missed |= !inside(run.samples[k].states[i], x, 1e-54 * (1 + std::abs(cln::double_approx(x))));
    }
  }
  counts.missed += missed ? 1 : 0;
}

Counts random_trials(int trials, bool with_boxes, const ValidatedSettings& settings) {
  Counts counts;
  RandomSystem random(with_boxes ? 7 : 19);
  for (int trial = 0; trial < trials; ++trial) {
    const Program rates = random.program();
    std::vector<cln::cl_RA> start;
    for (std::size_t i = 0; i < rates.outputs.size(); ++i) start.push_back(random.number(1));
    start.push_back(cln::cl_RA(random.whole(1, 9)) / 13 * (random.whole(0, 3) == 0 ? -1 : 1));
    ValidatedProblem problem = problem_of(rates, start);
    const cln::cl_RA radius = cln::expt(cln::cl_RA(10), -random.whole(2, 13));
    if (with_boxes) problem.radii.assign(rates.outputs.size(), radius);
    ValidatedSettings how = settings;
    how.max_steps = 2000;
    how.sample_every = cln::abs(start.back()) / 3 + cln::cl_RA(1) / 1000;
    const ValidatedRun run = validated_run(problem, how);
    if (run.status != ValidatedStatus::ok) {
      ++counts.refused;
      continue;
    }
    ++counts.enclosed;
    for (int corner = 0; corner < (with_boxes ? 2 : 1); ++corner) {
      std::vector<cln::cl_RA> from = start;
      for (std::size_t i = 0; with_boxes && i < rates.outputs.size(); ++i)
        from[i] = from[i] + radius * random.whole(0, 1) * 2 - radius;
      compare(problem, run, from, how.sample_every, counts);
    }
  }
  return counts;
}

/// How many systems: few, or what CASIMIR_VALIDATED_TRIALS says.
int trials() {
  const char* const asked = std::getenv("CASIMIR_VALIDATED_TRIALS");
  return asked ? std::atoi(asked) : 250;
}

void expect_right(const Counts& counts, const char* what) {
  EXPECT_EQ(counts.missed, 0) << what;
  EXPECT_GT(counts.enclosed, counts.refused) << what;
  EXPECT_GT(counts.compared, 9 * counts.unconfirmed) << what;
  ::testing::Test::RecordProperty(what, counts.compared);
}

TEST(Validated, BoxesOfRandomSystemsContainTheirSolutions) {
  expect_right(random_trials(trials(), false, {}), "points");
}

TEST(Validated, BoxesOfRandomSystemsContainTheSolutionsFromTheCornersOfTheirStarts) {
  expect_right(random_trials(trials(), true, {}), "boxes");
}

TEST(Validated, BoxesWithManyDigitsContainTheirSolutionsToo) {
  ValidatedSettings settings;
  settings.digits = 20;
  expect_right(random_trials(trials() / 5, false, settings), "digits");
  expect_right(random_trials(trials() / 5, true, settings), "digits and boxes");
}

// With a tolerance at which the remainder matters: without it solutions are missed.
TEST(Validated, MissesSolutionsWithoutTheRemainder) {
  ValidatedSettings coarse;
  coarse.order = 6;
  coarse.log2_error = -24;
  expect_right(random_trials(100, false, coarse), "coarse");
  coarse.without_remainder = true;
  EXPECT_GT(random_trials(100, false, coarse).missed, 10);
}

}  // namespace
}  // namespace casimir
