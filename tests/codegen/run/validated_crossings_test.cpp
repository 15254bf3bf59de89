// Crossings that are said to be all there are, against closed forms.
#include <cln/float.h>
#include <cln/real.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>

#include "codegen/optimise/differentiate.hpp"
#include "runtime/trace_check.hpp"
#include "runtime/validated_run.hpp"
#include "tests/runtime/programs.hpp"

namespace casimir {
namespace {

using test::Builder;

/// dx/dt = y, dy/dt = -x from (0, 5): x = 5 sin t.
ValidatedProblem turning(const cln::cl_RA& duration) {
  Builder rates({"x", "y"});
  rates.output(1);
  rates.output(rates.op(Op::neg, 0));
  ValidatedProblem problem;
  problem.rates = rates.program();
  const SparseProgram jacobian = codegen::jacobian(problem.rates, 2);
  problem.jacobian = jacobian.program;
  problem.entries = jacobian.entries;
  for (const cln::cl_RA& value : {cln::cl_RA(0), cln::cl_RA(5), duration}) {
    problem.start.code.push_back({Op::constant, static_cast<int>(problem.start.constants.size())});
    problem.start.constants.push_back(value);
    problem.start.outputs.push_back(static_cast<int>(problem.start.code.size()) - 1);
    problem.start.output_names.emplace_back("s");
  }
  return problem;
}

/// The surface x = level, and the rate y of x.
Program level_of_x(const cln::cl_RA& level) {
  Builder b({"x", "y"});
  b.output(b.op(Op::sub, 0, b.number(level)));
  b.output(1);
  return b.program();
}

testing::AssertionResult near_and_inside(const RationalInterval& interval, double value,
                                         double width) {
  const double low = cln::double_approx(interval.low), high = cln::double_approx(interval.high);
  if (low - 1e-13 <= value && value <= high + 1e-13 && high - low < width)
    return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << std::setprecision(17) << value << " and [" << low << ", " << high << "]";
}

/// Times of 0 < t < end at which 5 sin t = level, in order.
std::vector<double> times_of(double level, double end) {
  const double pi = std::acos(-1.), first = std::asin(level / 5);
  std::vector<double> result;
  for (int k = -1; 2 * k * pi < end; ++k)
    for (const double t : {first + 2 * k * pi, pi - first + 2 * k * pi})
      if (t > 1e-12 && t < end) result.push_back(t);
  return result;
}

TEST(ValidatedCrossings, AreThoseOfTheClosedForm) {
  for (const int digits : {0, 25}) {
    for (const int tenths : {0, 7, -31, 49}) {
      const cln::cl_RA level = cln::cl_RA(tenths) / 10;
      ValidatedProblem problem = turning(digits == 0 ? 60 : 15);
      problem.plane = level_of_x(level);
      ValidatedSettings settings;
      settings.digits = digits;
      const ValidatedRun run = validated_run(problem, settings);
      ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
      EXPECT_EQ(run.starts_on_plane, tenths == 0);
      EXPECT_EQ(run.crossings_until, run.end.time);
      const std::vector<double> truth = times_of(tenths / 10., cln::double_approx(run.end.time));
      ASSERT_EQ(run.crossings.size(), truth.size()) << tenths;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_TRUE(near_and_inside(run.crossings[i].time, truth[i], 1e-11)) << i;
        EXPECT_TRUE(near_and_inside(run.crossings[i].states[0], tenths / 10., 1e-10)) << i;
        EXPECT_EQ(run.crossings[i].upwards, std::cos(truth[i]) > 0);
      }
    }
  }
}

TEST(ValidatedCrossings, BackwardsInTimeTheyHaveTheSameDirections) {
  ValidatedProblem problem = turning(-10);
  problem.plane = level_of_x(1);
  const ValidatedRun run = validated_run(problem, {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  const double pi = std::acos(-1.), first = std::asin(0.2);
  const std::vector<double> truth = {-pi - first, first - 2 * pi, -3 * pi - first};
  ASSERT_EQ(run.crossings.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_TRUE(near_and_inside(run.crossings[i].time, truth[i], 1e-11)) << i;
    EXPECT_EQ(run.crossings[i].upwards, std::cos(truth[i]) > 0);
  }
}

/// x reaches 5 at t = pi/2 and no more.
TEST(ValidatedCrossings, WhereAnOrbitTouchesNothingIsSaid) {
  ValidatedProblem problem = turning(10);
  problem.plane = level_of_x(5);
  const ValidatedRun run = validated_run(problem, {});
  EXPECT_EQ(run.status, ValidatedStatus::touching);
  EXPECT_TRUE(run.crossings.empty());
  EXPECT_LE(cln::double_approx(run.crossings_until), std::acos(-1.) / 2);
  EXPECT_GT(cln::double_approx(run.crossings_until), 1);
}

/// Two crossings 3e-4 apart are two, and a surface that is missed by 1e-9 is missed.
TEST(ValidatedCrossings, TellsPassingFromTouching) {
  ValidatedProblem problem = turning(10);
  problem.plane = level_of_x(5 - cln::cl_RA(1) / 10000000);
  const ValidatedRun twice = validated_run(problem, {});
  ASSERT_EQ(twice.status, ValidatedStatus::ok) << twice.reason;
  ASSERT_EQ(twice.crossings.size(), 4U);
  EXPECT_LT(twice.crossings[0].time.high, twice.crossings[1].time.low);
  problem.plane = level_of_x(5 + cln::cl_RA(1) / 1000000000);
  const ValidatedRun never = validated_run(problem, {});
  ASSERT_EQ(never.status, ValidatedStatus::ok) << never.reason;
  EXPECT_TRUE(never.crossings.empty());
}

/// Without the sign of the derivative both of a pair are missed.
TEST(ValidatedCrossings, MissesCrossingsWhereMonotonyIsNotAsked) {
  ValidatedProblem problem = turning(10);
  problem.plane = level_of_x(cln::cl_RA(49) / 10);
  ASSERT_EQ(validated_run(problem, {}).crossings.size(), 4U);
  ValidatedSettings careless;
  careless.without_monotony = true;
  EXPECT_LT(validated_run(problem, careless).crossings.size(), 4U);
}

/// Of a box of starts every member has each crossing.
TEST(ValidatedCrossings, OfABoxAreThoseOfItsMembers) {
  ValidatedProblem problem = turning(10);
  problem.plane = level_of_x(1);
  problem.radii = {cln::cl_RA(1) / 1000, cln::cl_RA(1) / 1000};
  const ValidatedRun run = validated_run(problem, {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  ASSERT_EQ(run.crossings.size(), 4U);
  for (const double x : {-1e-3, 1e-3}) {
    for (const double y : {5 - 1e-3, 5 + 1e-3}) {
      const double size = std::hypot(x, y), phase = std::atan2(x, y);
      const double first = std::asin(1 / size) - phase;
      EXPECT_TRUE(near_and_inside(run.crossings[0].time, first, 1e-3));
      EXPECT_TRUE(
          near_and_inside(run.crossings[0].states[1], size * std::cos(first + phase), 1e-2));
    }
  }
}

/// A surface that moves: sin t with the time in it, of a state at rest.
TEST(ValidatedCrossings, OfAFunctionOfTheTime) {
  ValidatedProblem problem = turning(100);
  Builder b({"x", "y"});
  b.output(b.op(Op::sin, b.time()));
  b.output(b.op(Op::cos, b.time()));
  problem.plane = b.program();
  const ValidatedRun run = validated_run(problem, {});
  ASSERT_EQ(run.status, ValidatedStatus::ok) << run.reason;
  ASSERT_EQ(run.crossings.size(), 31U);
  for (std::size_t i = 0; i < run.crossings.size(); ++i)
    EXPECT_TRUE(
        near_and_inside(run.crossings[i].time, std::acos(-1.) * static_cast<double>(i + 1), 1e-10));
}

/// Every step of a run is verified by other arithmetic, in both directions of the time.
TEST(ValidatedTrace, OfARunIsVerifiedInBothDirections) {
  for (const int duration : {9, -9}) {
    for (const bool wide : {false, true}) {
      ValidatedProblem problem = turning(duration);
      if (wide) problem.radii = {cln::cl_RA(1) / 1000, 0};
      RunTrace trace;
      ValidatedSettings settings;
      settings.trace = &trace;
      ASSERT_EQ(validated_run(problem, settings).status, ValidatedStatus::ok);
      TraceCheckSettings with_derivatives;
      with_derivatives.derivatives = true;
      const TraceCheck check = check_trace(problem, trace, with_derivatives);
      ASSERT_EQ(check.fault, TraceFault::none) << check.step;
      EXPECT_TRUE(near_and_inside(check.end[0], 5 * std::sin(duration), 1e-2));
      const std::vector<double> rotation = {std::cos(duration), std::sin(duration),
                                            -std::sin(duration), std::cos(duration)};
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(near_and_inside(check.derivatives[i], rotation[i], 1e-12)) << i;
      trace.steps.back().after.middle[0] = "0x1p0";
      EXPECT_EQ(check_trace(problem, trace).fault, TraceFault::outside);
    }
  }
}

}  // namespace
}  // namespace casimir
