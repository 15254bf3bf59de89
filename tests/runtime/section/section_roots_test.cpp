// Passages of a polynomial through zero: all of them, and none twice.
#include "runtime/section/section_roots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace casimir {
namespace {

using Coefficients = std::vector<double>;

/// Product of (s - root), times a factor.
Coefficients with_roots(const std::vector<double>& roots, double factor = 1) {
  Coefficients c{factor};
  for (const double root : roots) {
    c.push_back(0);
    for (std::size_t k = c.size() - 1; k > 0; --k) c[k] = c[k - 1] - root * c[k];
    c[0] *= -root;
  }
  return c;
}

double value(const Coefficients& c, double s) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
  return sum;
}

TEST(Passages, OfAProductAreItsFactors) {
  const std::vector<double> roots{0.1, 0.35, 0.35001, 0.6, 0.95};
  const Coefficients c = with_roots({0.1, 0.35, 0.35001, 0.6, 0.95, -0.2, 1.3});
  const std::vector<PolynomialRoot> found = passages(c, 1, value(c, 0) > 0);
  ASSERT_EQ(found.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_NEAR(found[i].at, roots[i], 1e-8);
    EXPECT_EQ(found[i].rising, (value(c, 0) < 0) == (i % 2 == 0));
  }
}

TEST(Passages, OfAChebyshevPolynomialAreItsSixteenZeros) {
  // T_16(2 s - 1): as many zeros in a step as there can be.
  Coefficients before{1}, c{-1, 2};
  for (int n = 1; n < 16; ++n) {
    Coefficients next(c.size() + 1);
    for (std::size_t k = 0; k < c.size(); ++k) {
      next[k] -= 2 * c[k];
      next[k + 1] += 4 * c[k];
    }
    for (std::size_t k = 0; k < before.size(); ++k) next[k] -= before[k];
    before = std::exchange(c, next);
  }
  const std::vector<PolynomialRoot> found = passages(c, 1, true);
  ASSERT_EQ(found.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    const double root = (1 - std::cos(std::acos(-1.) * (2 * static_cast<double>(i) + 1) / 32)) / 2;
    EXPECT_NEAR(found[i].at, root, 1e-7);
    EXPECT_EQ(found[i].rising, i % 2 == 1);
  }
}

TEST(Passages, TouchingIsNone) {
  EXPECT_TRUE(passages(with_roots({0.25, 0.25}), 1, true).empty());
  // Three at one point pass once.
  EXPECT_EQ(passages(with_roots({0.5, 0.5, 0.5}), 1, false).size(), 1U);
}

/// A step is cut in two at a zero, where rounding may say either sign of both ends.
TEST(Passages, OnTheJointOfTwoStepsCountOnce) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> place(0.2, 0.8);
  for (int round = 0; round < 2000; ++round) {
    const double root = place(engine);
    const Coefficients c = with_roots({root, 2.5, -1.5});
    const double cut = std::nextafter(root, round % 2 == 0 ? 0 : 1);
    // The second step: the same polynomial about the cut.
    Coefficients rest = c;
    for (std::size_t i = 0; i < rest.size(); ++i)
      for (std::size_t k = rest.size() - 1; k > i; --k) rest[k - 1] += cut * rest[k];
    rest[0] += (round % 3 - 1) * 1e-16;  // the rounding of a step
    const bool above = value(c, 0) > 0;
    const std::vector<PolynomialRoot> first = passages(c, cut, above);
    const bool side = above != (first.size() % 2 == 1);
    const std::vector<PolynomialRoot> second = passages(rest, 1 - cut, side);
    EXPECT_EQ(first.size() + second.size(), 1U) << root << ' ' << round;
  }
}

TEST(Passages, BackwardsInTimeAreFoundToo) {
  const std::vector<PolynomialRoot> found = passages(with_roots({-0.5, -2}), -1, true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].at, -0.5, 1e-15);
  EXPECT_FALSE(found[0].rising);
}

}  // namespace
}  // namespace casimir
