#pragma once

namespace casimir_kernel::taylor {

/// 1/k, for the recurrences, and what rounding it to double lost: a factor that is rounded once
/// errs in the same direction at every step, which a million steps show.
struct Reciprocals {
  /// Terms beyond this order are too small for a million steps to show the error of their factor.
  static constexpr int felt = 8;
  double of[32] = {};
  double rest[32] = {};
  constexpr Reciprocals() {
    for (int k = 1; k < 32; ++k) {
      of[k] = 1. / k;
      // k of[k] in two parts that are exact, as k has five digits.
      const double high = static_cast<float>(of[k]), low = of[k] - high;
      rest[k] = ((1 - k * high) - k * low) / k;
    }
  }
};
inline constexpr Reciprocals reciprocal;

/// unit / k as a factor, in two parts.
template <class V>
struct Part {
  V high, low;
  Part(V unit, int k) : high(unit * reciprocal.of[k]), low(unit * reciprocal.rest[k]) {}
  /// \param rate  a V, or a number that is the same in every lane.
  template <class Rate>
  inline __attribute__((always_inline)) V operator*(Rate rate) const {
    return rate * high + rate * low;
  }
};

}  // namespace casimir_kernel::taylor
