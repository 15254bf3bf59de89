// How a Taylor series goes on behind its last coefficient: planted singularities, and what must not
// be continued.
#include "runtime/kernels/taylor/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "runtime/kernels/taylor/sums.hpp"

namespace casimir::test {
namespace {

using namespace casimir_kernel;
using casimir_kernel::taylor::Continuation;
using V = Lanes2;
using Complex = std::complex<double>;

constexpr int kPlantedOrder = 24;

/// States in so many registers of two, and their coefficients.
template <int registers>
struct PlantedSeries {
  static constexpr int blocks = registers, states = 2 * registers, order = kPlantedOrder;
  V c[kPlantedOrder + 1][blocks] = {};

  void set(int state, int k, double value) { c[k][state / 2][state % 2] = value; }
};

/// A pair of poles r and its conjugate, of the order 1 or 2, with this residue in state i.
struct Pole {
  Complex at;
  int order;
  Complex strength(int state) const {
    return {std::cos(3 * state + 5 * at.real()), std::sin(2 * state * at.imag() + 1)};
  }
  /// The coefficient of s^k of 2 Re(strength/(1 - s/at)^order).
  double coefficient(int state, int k) const {
    return 2 * (strength(state) * std::pow(at, -k)).real() * (order == 1 ? 1 : k + 1);
  }
  double value(int state, double s) const {
    return 2 * (strength(state) / std::pow(1. - s / at, order)).real();
  }
  double slope(int state, double s) const {
    const double n = order;
    return 2 * (strength(state) * n / at / std::pow(1. - s / at, n + 1)).real();
  }
};

template <int registers = 3>
PlantedSeries<registers> series_of(const std::vector<Pole>& poles) {
  PlantedSeries<registers> series;
  for (int state = 0; state < series.states; ++state)
    for (int k = 0; k <= kPlantedOrder; ++k) {
      double sum = 0;
      for (const Pole& pole : poles) sum += pole.coefficient(state, k);
      series.set(state, k, sum);
    }
  return series;
}

const V kWeightsOfOne[3] = {{1, 1}, {1, 1}, {1, 1}};

using ContinuedSum = Continuation<V, 3>;

/// The largest error of the sum after s units, and of its derivative times s.
template <int registers>
std::pair<double, double> errors(const std::vector<Pole>& poles,
                                 const PlantedSeries<registers>& series,
                                 const ContinuedSum& continued, double s) {
  V sum[registers], slope[registers];
  taylor::increment(series, s, sum);
  taylor::slope(series, s, slope);
  if (continued.used()) {
    continued.add(kPlantedOrder, registers, s, sum);
    continued.add_slope(kPlantedOrder, registers, s, slope);
  }
  double error = 0, error_of_slope = 0;
  for (int state = 0; state < series.states; ++state) {
    double value = 0, derivative = 0;
    for (const Pole& pole : poles) {
      value += pole.value(state, s) - pole.coefficient(state, 0);
      derivative += pole.slope(state, s) * s;
    }
    error = std::max(error, std::abs(sum[state / 2][state % 2] - value));
    error_of_slope = std::max(error_of_slope, std::abs(slope[state / 2][state % 2] - derivative));
  }
  return {error, error_of_slope};
}

TEST(Continuation, TwoPairsOfPolesAreContinuedExactly) {
  const std::vector<Pole> poles{{{0.5, 1.2}, 1}, {{-0.8, 1.3}, 1}};
  const auto series = series_of(poles);
  ContinuedSum continued;
  const auto before = errors(poles, series, continued, 0.8);
  EXPECT_GT(before.first, 1e-5);
  const ContinuedSum::Missed missed = continued.fit(series, kWeightsOfOne);
  EXPECT_LT(missed.last, 1e-6 * std::abs(series.c[kPlantedOrder][0][0]));
  EXPECT_LT(missed.before, 1e-6 * std::abs(series.c[kPlantedOrder - 1][0][0]));
  ASSERT_TRUE(continued.use(series, 0.8));
  for (const double s : {-0.7, 0.1, 0.4, 0.8}) {
    const auto [error, error_of_slope] = errors(poles, series, continued, s);
    EXPECT_LT(error, 1e-12) << s;
    EXPECT_LT(error_of_slope, 1e-11) << s;
  }
}

// One pair leaves two terms without anything to fit: the normal equations are singular. In one
// register they are those of two orders.
TEST(Continuation, FewerPolesThanTermsAreNoDifficulty) {
  for (const Pole& pole : {Pole{{0.5, 1.2}, 1}, Pole{{0.5, 1.2}, 2}, Pole{{-1.1, 0}, 1}}) {
    const auto series = series_of<1>({pole});
    ContinuedSum continued;
    continued.fit(series, kWeightsOfOne);
    ASSERT_TRUE(continued.use(series, 0.7));
    EXPECT_LT(errors({pole}, series, continued, 0.7).first, 1e-11);
  }
}

// What the continuation is trusted for has to say how wrong it is, here where more singularities
// are near than it has terms for.
TEST(Continuation, WhatTheLastCoefficientsMissTellsTheError) {
  const std::vector<Pole> poles{{{0.5, 1.2}, 1}, {{-0.8, 1.3}, 2}, {{1.3, 1.1}, 1}};
  const auto series = series_of(poles);
  ContinuedSum continued;
  const ContinuedSum::Missed missed = continued.fit(series, kWeightsOfOne);
  for (const double s : {0.4, 0.55, 0.7}) {
    const double plain = errors(poles, series, continued, s).first;
    ASSERT_TRUE(continued.use(series, s));
    const double error = errors(poles, series, continued, s).first;
    continued.forget();
    EXPECT_LT(error, plain / 10) << s;
    EXPECT_LT(error, 2 * missed.last * std::pow(s, kPlantedOrder)) << s;
  }
}

// A pole on the way, which the motion runs into: nothing may be continued towards it, let alone
// across it.
TEST(Continuation, StopsBeforePolesOnTheWay) {
  const auto series = series_of({{{1, 0}, 1}, {{0.5, 1.2}, 1}});
  ContinuedSum continued;
  continued.fit(series, kWeightsOfOne);
  EXPECT_TRUE(continued.use(series, 0.3));
  for (const double s : {0.65, 0.7, 0.99, 1.2}) {
    EXPECT_FALSE(continued.use(series, s)) << s;
    EXPECT_FALSE(continued.used());
  }
  // Nor does a step of the series itself, where nobody sees how large its terms are.
  EXPECT_EQ(continued.before_zero(0.3), 0.3);
  EXPECT_LT(continued.before_zero(2), 0.55);
  EXPECT_GT(continued.before_zero(2), 0.4);
}

TEST(Continuation, NumbersThatAreNoneAreNotUsed) {
  auto series = series_of({{{0.5, 1.2}, 1}});
  series.set(0, kPlantedOrder - 5, std::nan(""));
  ContinuedSum continued;
  const ContinuedSum::Missed missed = continued.fit(series, kWeightsOfOne);
  EXPECT_FALSE(missed.last < 1e300);
  EXPECT_FALSE(continued.use(series, 0.5));
}

}  // namespace
}  // namespace casimir::test
