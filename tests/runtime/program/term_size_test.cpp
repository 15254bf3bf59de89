// What a drift of an invariant is measured against.
#include "runtime/program/term_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace casimir::test {
namespace {

using Sized = Arithmetic<SizedNumber>;

/// A number that is the sum of terms of this size.
SizedNumber of(long double value, long double size) { return {value, size}; }

TEST(TermSize, OfAFunctionThatVanishesIsThatOfItsArgument) {
  EXPECT_EQ(Sized::log(of(1, 1)).size, 1);
  EXPECT_EQ(Sized::log(of(1, 7)).size, 7);
  EXPECT_NEAR(static_cast<double>(Sized::function(Op::sin, of(0, 3)).size), 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::function(Op::sinh, of(0, 3)).size), 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::function(Op::tan, of(0, 3)).size), 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::function(Op::tanh, of(0, 3)).size), 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::function(Op::exp, of(0, 3)).size), 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::atan2(of(0, 3), of(2, 2)).size), 1.5, 1e-15);
  EXPECT_NEAR(static_cast<double>(Sized::asin(of(0, 3)).size), 3, 1e-15);
}

/// cos(x) changes by nothing to first order at 0: it is measured against its value.
TEST(TermSize, OfAFunctionThatDoesNotIsItsValueAtLeast) {
  EXPECT_EQ(Sized::function(Op::cos, of(0, 3)).size, 1);
  EXPECT_EQ(Sized::log(of(std::exp(4.0L), 1)).size, 4);
}

TEST(TermSize, OfARootBesideItsEdgeIsThatOfWhatErrorsMakeOfIt) {
  const long double error = 1e-16L;
  EXPECT_LE(Sized::sqrt(of(error, 1)).value / Sized::sqrt(of(error, 1)).size, 1e-15L);
  EXPECT_LE(Sized::acos(of(1 - error, 1)).value / Sized::acos(of(1 - error, 1)).size, 1e-15L);
  EXPECT_EQ(Sized::sqrt(of(4, 4)).size, 2);
}

TEST(TermSize, ALittleBeyondAnEdgeIsOnIt) {
  EXPECT_EQ(Sized::sqrt(of(-1e-12L, 1)).value, 0);
  EXPECT_EQ(Sized::acos(of(1 + 1e-12L, 1)).value, 0);
  EXPECT_EQ(Sized::asin(of(-1 - 1e-12L, 1)).value, std::asin(-1.0L));
  EXPECT_TRUE(std::isnan(Sized::sqrt(of(-1e-3L, 1)).value));
  EXPECT_TRUE(std::isnan(Sized::sqrt(of(-1e-12L, 1e-12L)).value));
  EXPECT_TRUE(std::isnan(Sized::asin(of(1.001L, 1)).value));
}

}  // namespace
}  // namespace casimir::test
