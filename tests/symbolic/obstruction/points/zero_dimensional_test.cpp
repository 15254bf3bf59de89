// Common zeros of polynomials, exactly.
#include "symbolic/obstruction/points/zero_dimensional.hpp"

#include <gtest/gtest.h>

namespace casimir::obstruction {
namespace {

long count(const CommonZeros& zeros) {
  long result = 0;
  for (const AlgebraicPoint& p : zeros.points) result += p.field.degree();
  return result;
}

TEST(CommonZeros, AreAllFoundOnce) {
  const PolynomialRing ring(2);
  const Polynomial x = ring.variable(0), y = ring.variable(1), one = ring.constant(1);
  // Four points on a circle, conjugate in pairs or not.
  const CommonZeros circle = common_zeros({x * x + y * y - one, x * x - y * y.scaled(2)}, [] {});
  EXPECT_TRUE(circle.finite);
  EXPECT_EQ(count(circle), 4);
  // With multiplicity.
  const CommonZeros tangent = common_zeros({(y - x * x) * (y - x * x), y * y}, [] {});
  EXPECT_EQ(count(tangent), 1);
  EXPECT_EQ(count(common_zeros({x * y - one, x * x * x - one.scaled(2)}, [] {})), 3);
}

TEST(CommonZeros, ThereMayBeNoneOrInfinitelyMany) {
  const PolynomialRing ring(2);
  const Polynomial x = ring.variable(0), y = ring.variable(1), one = ring.constant(1);
  const CommonZeros none = common_zeros({x, x - one}, [] {});
  EXPECT_TRUE(none.finite);
  EXPECT_TRUE(none.points.empty());
  EXPECT_FALSE(common_zeros({x * y, x * (y - one)}, [] {}).finite);
}

}  // namespace
}  // namespace casimir::obstruction
