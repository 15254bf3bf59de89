// The orbits by which conditional claims are checked must not be followed where a branch is open.
#include "tests/adversary/orbit.hpp"

#include <gtest/gtest.h>

namespace casimir::adversary {
namespace {

Case moving_by(const Expr& rate) {
  Case claim;
  claim.system.variables = {"x", "y"};
  claim.system.equations = {rate, Expr(0)};
  return claim;
}

/// x after the time 1/2, from x = 0 and y = 1/3.
double end_of(const Case& claim) {
  Point last{{"x", Ball(0)}, {"y", Ball::ratio(1, 3)}};
  follow(claim, last, 0.5, [&](const Point& point) {
    last = point;
    return true;
  });
  return last.at("x").as_double();
}

TEST(Orbit, EndsAtAnAngleOnItsCut) {
  const Expr y("y");
  EXPECT_NEAR(end_of(moving_by(atan2(y - Expr(1, 3), Expr(1)))), 0, 1e-40);
  EXPECT_NEAR(end_of(moving_by(atan2(y, Expr(1)))), 0.16087527719832109, 1e-15);
  // atan2(0, -1) is Pi or, by the rounding of 1/3, -Pi: their mean is neither.
  EXPECT_THROW(end_of(moving_by(atan2(y - Expr(1, 3), Expr(-1)))), Unknown);
}

TEST(Ball, IsSharpWhereItIsKnownToFortyDigits) {
  EXPECT_TRUE(Ball(0).is_sharp());
  EXPECT_TRUE(Ball(-7).is_sharp());
  EXPECT_TRUE(Ball::ratio(1, 3).is_sharp());
  EXPECT_TRUE((Ball::ratio(1, 3) - Ball::ratio(1, 3)).is_sharp());
  EXPECT_FALSE((Ball(1) / (Ball::ratio(1, 3) - Ball::ratio(1, 3))).is_sharp());
}

}  // namespace
}  // namespace casimir::adversary
