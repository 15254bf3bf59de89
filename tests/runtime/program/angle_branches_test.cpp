// Angles that are followed from branch to branch.
#include "runtime/program/angle_branches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace casimir {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// atan2(y, x) - factor * t over the states x, y.
Program turning(long factor) {
  Program program;
  program.inputs = {"x", "y", "t"};
  program.constants = {cln::cl_RA(factor)};
  program.code = {{Op::input, 0},        {Op::input, 1},  {Op::input, 2}, {Op::atan2, 1, 0},
                  {Op::constant, 0, -1}, {Op::mul, 4, 2}, {Op::sub, 3, 5}};
  program.outputs = {6};
  program.output_names = {"F"};
  return program;
}

/// What is left of F at the end of a motion (x, y)(t) in steps of one size.
long double followed(const Program& program, double step, int steps,
                     const std::function<std::pair<double, double>(double)>& motion) {
  const auto state_at = [&](double t, double* x) { std::tie(x[0], x[1]) = motion(t); };
  const auto rates = [&](double t, const double*, double* dx) {
    constexpr double kSmall = 1e-6;
    for (int k = 0; k < 2; ++k) {
      double before[2], after[2];
      state_at(t - kSmall, before);
      state_at(t + kSmall, after);
      dx[k] = (after[k] - before[k]) / (2 * kSmall);
    }
  };
  std::vector<double> x(2);
  state_at(0, x.data());
  AngleFollower follower(program, {}, rates, 0, x);
  for (int k = 1; k <= steps; ++k) {
    state_at(k * step, x.data());
    follower.advance(k * step, x.data(), state_at);
  }
  long double value = 0;
  follower.put(steps * step, x.data(), &value);
  return value;
}

std::function<std::pair<double, double>(double)> circle(double speed) {
  return [speed](double t) { return std::pair(std::cos(speed * t), std::sin(speed * t)); };
}

// Whatever the steps are: at 3.14 an angle goes half a turn in each, at 9 more than one.
TEST(AngleBranches, AreFollowedThroughManyTurns) {
  for (const double step : {0.01, 0.5, 1.9, 3.14, 9.})
    EXPECT_NEAR(static_cast<double>(followed(turning(1), step, 60, circle(1))), 0, 1e-9) << step;
  EXPECT_NEAR(static_cast<double>(followed(turning(-7), 0.8, 60, circle(-7))), 0, 1e-9);
}

// The twin: an angle that turns once more in the time is another one, though it ends at the same
// point.
TEST(AngleBranches, AFalseIntegralStillChanges) {
  const double end = 2 * kPi / 40;
  EXPECT_NEAR(static_cast<double>(followed(turning(2), end, 40, circle(1))), -2 * kPi, 1e-9);
  EXPECT_NEAR(static_cast<double>(followed(turning(1), end, 400, circle(2))), 20 * kPi, 1e-9);
}

// A motion that goes close by the origin turns by half a turn within a small part of a step.
TEST(AngleBranches, APassCloseToTheOriginIsResolved) {
  for (const double aside : {1e-2, -1e-2, 1e-5, -1e-5}) {
    const auto line = [aside](double t) { return std::pair(t - 1.7, aside); };
    // From the left to the right: no cut is crossed.
    EXPECT_NEAR(static_cast<double>(followed(turning(0), 1, 4, line)), 0, 0.1) << aside;
  }
  // Down the left side, close by: from +90 degrees over 180 to 270.
  const auto down = [](double t) { return std::pair(-1e-4, 1.7 - t); };
  EXPECT_NEAR(static_cast<double>(followed(turning(0), 1, 4, down)), 1.5 * kPi, 1e-3);
}

// Through the origin itself the angle jumps by half a turn, and no branch of it does.
TEST(AngleBranches, AJumpThatIsNoBranchStays) {
  const auto through = [](double t) { return std::pair(t - 1.7, 2 * (t - 1.7)); };
  const double change =
      static_cast<double>(followed(turning(0), 1, 4, through)) - std::atan2(-3.4, -1.7);
  EXPECT_NEAR(std::abs(change), kPi, 1e-9);
}

TEST(AngleBranches, OneOfAQuotientMeetsTheNextWhereItIsInfinite) {
  Program program = turning(1);
  program.constants.emplace_back(1);
  // atan2(y/x, 1) - t
  program.code = {{Op::input, 0},        {Op::input, 1},    {Op::input, 2}, {Op::div, 1, 0},
                  {Op::constant, 1, -1}, {Op::atan2, 3, 4}, {Op::sub, 5, 2}};
  ASSERT_EQ(moving_angles(program, 2).size(), 1u);
  EXPECT_EQ(moving_angles(program, 2)[0].half_turns, 1);
  EXPECT_EQ(moving_angles(turning(1), 2)[0].half_turns, 2);
  for (const double step : {0.1, 1.9, 4.})
    EXPECT_NEAR(static_cast<double>(followed(program, step, 60, circle(1))), 0, 1e-9) << step;
}

TEST(AngleBranches, BetweenTwoPointsAreTakenWhereTheyDifferLeast) {
  const Program program = turning(1);
  const auto angles = moving_angles(program, 2);
  const auto at = [](double angle, double t) {
    return std::vector<long double>{std::cos(angle), std::sin(angle), t};
  };
  EXPECT_NEAR(
      static_cast<double>(least_differences(program, angles, at(0.3, 0), at(100.3, 100))[0]), 0,
      1e-12);
  EXPECT_NEAR(
      static_cast<double>(least_differences(program, angles, at(0.3, 0), at(100.3, 100.5))[0]),
      -0.5, 1e-12);
  // Where the factor of the angle changes, or the angle is in no sum, a difference is what it is.
  Program product = program;
  product.code[6] = {Op::mul, 3, 5};
  const auto raw = [&](double angle, double t) { return std::remainder(angle, 2 * kPi) * t; };
  EXPECT_NEAR(static_cast<double>(least_differences(product, angles, at(0.3, 1), at(4.3, 100))[0]),
              raw(4.3, 100) - raw(0.3, 1), 1e-9);
}

}  // namespace
}  // namespace casimir
