// Where zeros are in a step: no rounding loses a time.
#include "runtime/validated/crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace casimir::validated {
namespace {

cln::cl_RA exact(double x) { return cln::rational(cln::cl_DF(x)); }

/// Newton's step is much longer than the stretch where the derivative is nearly zero: the end that
/// counts is the difference of large numbers.
TEST(Shares, AShiftIsNotShorterThanTheExactOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 2000; ++k) {
    const double size = std::ldexp(1., k % 40), middle = unit(random),
                 shift = size * (1 + unit(random)), radius = shift - unit(random);
    const Share share = shifted_share(middle, shift, radius);
    EXPECT_TRUE(exact(share.from) <= exact(middle) - exact(shift) - exact(radius));
    EXPECT_TRUE(exact(share.to) >= exact(middle) - exact(shift) + exact(radius));
    const Share other = shifted_share(middle, -shift, radius);
    EXPECT_TRUE(exact(other.from) <= exact(middle) + exact(shift) - exact(radius));
  }
}

TEST(Shares, ABallHasBothEnds) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 2000; ++k) {
    const double from = unit(random), to = from + (1 - from) * std::ldexp(unit(random), -(k % 50));
    const MidRad ball = ball_of({from, to});
    EXPECT_TRUE(exact(ball.mid) - exact(ball.rad) <= exact(from));
    EXPECT_TRUE(exact(ball.mid) + exact(ball.rad) >= exact(to));
  }
}

}  // namespace
}  // namespace casimir::validated
