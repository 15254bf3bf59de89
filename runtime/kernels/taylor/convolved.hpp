#pragma once

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/reciprocals.hpp"

namespace casimir_kernel::taylor {

/// Storage for the recurrences of a straight-line program.
///
/// Every product, quotient and function of a series needs sums of l[j] r[k-j] over the earlier
/// coefficients of two series. The inner terms of these sums, j = 1 .. k-1, depend on no
/// coefficient of order k: all sums of the program are formed side by side in the lanes of
/// registers, before the rest of order k is done one operation after the other.
///
/// Only the recurrences are compiled for each system: what steps along the series is precompiled
/// (called_series.hpp) and finds `rate` and `c` at the beginning.
template <int the_states, int sums>
struct Convolved {
  static constexpr int width = kNativeWidth;
  using V = Lanes<width>;
  static constexpr int most = 24;  // the highest order
  static constexpr int states = the_states, blocks = (states + width - 1) / width;
  static constexpr int groups = (sums + width - 1) / width;

  V rate[blocks];
  V c[most + 1][blocks];
  int order;
  const double* p;

 protected:
  V left_[most][groups > 0 ? groups : 1], right_[most][groups > 0 ? groups : 1];
  double sum_[groups > 0 ? width* groups : 1];

  static CASIMIR_INLINE double lane(const V* x, int i) { return x[i / width][i % width]; }

  /// The numbers, side by side, in as many registers as they need.
  template <class... Numbers>
  static CASIMIR_INLINE void pack(V* to, Numbers... numbers) {
    const double all[(sizeof...(numbers) + width - 1) / width * width] = {numbers...};
    fill<0>(to, all);
  }

  /// The inner terms of order k of every sum.
  CASIMIR_INLINE void form_sums(int k) {
    CASIMIR_UNROLL
    for (int g = 0; g < groups; ++g) {
      V even = V{}, odd = V{};
      int j = 1;
      for (; j + 1 < k; j += 2) {
        even += left_[j][g] * right_[k - j][g];
        odd += left_[j + 1][g] * right_[k - j - 1][g];
      }
      if (j < k) even += left_[j][g] * right_[k - j][g];
      even += odd;
      __builtin_memcpy(sum_ + width * g, &even, sizeof even);
    }
  }

 private:
  template <int b, int count>
  static CASIMIR_INLINE void fill(V* to, const double (&all)[count]) {
    static constexpr long long lanes[] = {0, 1, 2, 3, 4, 5, 6, 7};
    to[b] = collected<V>(all + b * width, lanes);
    if constexpr ((b + 1) * width < count) fill<b + 1>(to, all);
  }
};

}  // namespace casimir_kernel::taylor
