#include "runtime/step/between_places.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace casimir::test {
namespace {

constexpr std::array<double, 6> kPlaces = {0, 0.15, 0.4, 0.65, 0.9, 1};

template <class Function>
std::array<double, 6> values_of(const Function& function) {
  std::array<double, 6> values = {};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = function(kPlaces[i]);
  return values;
}

TEST(BetweenPlaces, AFunctionStaysWithinItsReach) {
  for (int k = 0; k < 40; ++k) {
    const auto f = [k](double t) { return std::sin(0.2 * k * t + k) + 0.1 * k * t * t; };
    const auto values = values_of(f);
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      const double most = std::max(values[i], values[i + 1]) + reach(kPlaces, values, i);
      for (double t = kPlaces[i]; t < kPlaces[i + 1]; t += 0.01)
        EXPECT_LE(f(t), most) << k << ' ' << t;
    }
  }
}

/// The square of 1 - 2 t^10, which is 0 at t = 0.93: it hardly changes up to there, and what it
/// changes by is less than its least value at the places.
TEST(BetweenPlaces, ASlopeThatChangesAddsToTheReach) {
  const auto values = values_of([](double t) { return -std::pow(1 - 2 * std::pow(t, 10), 2); });
  EXPECT_GT(values[4] + reach(kPlaces, values, 4), 0);
  const auto straight = values_of([](double t) { return 3 - t; });
  EXPECT_NEAR(reach(kPlaces, straight, 2), 0.25, 1e-12);
}

TEST(BetweenPlaces, TheDipOfAParabolaIsFoundWhereItComesNearerToZero) {
  const auto dip =
      dip_at(kPlaces, values_of([](double t) { return 0.1 + std::pow(t - 0.45, 2); }), 1);
  ASSERT_TRUE(dip);
  EXPECT_NEAR(dip->place, 0.45, 1e-12);
  EXPECT_NEAR(dip->value, 0.1, 1e-12);
  EXPECT_FALSE(dip_at(kPlaces, values_of([](double t) { return 1 - std::pow(t - 0.45, 2); }), 1));
  EXPECT_FALSE(dip_at(kPlaces, values_of([](double t) { return t; }), 1));
}

}  // namespace
}  // namespace casimir::test
