#include "symbolic/functions/point_completer.hpp"

#include <gtest/gtest.h>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using functions::PointCompleter;
using GiNaC::ex;

class CompletedPoints : public testing::Test {
 protected:
  /// The point with these x, y, z and values of the generators, if there are such.
  std::optional<std::vector<cln::cl_RA>> completed(std::vector<cln::cl_RA> point) {
    const auto draw = [] { return cln::cl_RA(1) / 3; };
    const PointCompleter::Freedom freedom{.bare = std::vector<bool>(3, false)};
    if (!PointCompleter(ring_.table()).complete(point, draw, freedom)) return std::nullopt;
    return point;
  }

  GiNaC::symbol x_{"x"}, y_{"y"}, z_{"z"};
  ex angle_ = GiNaC::sin(x_), root_ = GiNaC::sqrt(y_), inverse_ = 1 / z_, log_ = GiNaC::log(y_);
  FunctionRing ring_{{x_, y_, z_}, {}, {angle_, GiNaC::cos(x_), root_, inverse_, log_}, {}};
};

TEST_F(CompletedPoints, ValuesObeyAllRelations) {
  const auto point = completed({0, cln::cl_RA(4) / 9, -7});
  ASSERT_TRUE(point);
  const auto value = [&](const ex& e) { return ring_.convert(e).evaluate(*point); };
  EXPECT_EQ(value(root_), cln::cl_RA(2) / 3);
  EXPECT_EQ(value(inverse_), -cln::cl_RA(1) / 7);
  const cln::cl_RA sine = value(angle_), cosine = value(GiNaC::cos(x_));
  EXPECT_EQ(sine * sine + cosine * cosine, 1);
  EXPECT_EQ(sine, cln::cl_RA(3) / 5);  // by the tangent of half the angle, 1/3
}

TEST_F(CompletedPoints, ThereIsNoneAtAPoleOrWhereARootIsNotRational) {
  EXPECT_FALSE(completed({0, 4, 0}));
  EXPECT_FALSE(completed({0, 2, 1}));
  EXPECT_FALSE(completed({0, -4, 1}));
  EXPECT_TRUE(completed({0, 4, 1}));
}

TEST_F(CompletedPoints, LogarithmsHaveNoValue) {
  const PointCompleter points(ring_.table());
  EXPECT_FALSE(points.has_value(ring_.convert(log_)));
  EXPECT_TRUE(points.has_value(ring_.convert(root_)));
}

}  // namespace
}  // namespace casimir
