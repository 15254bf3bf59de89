#pragma once

#include "runtime/kernels/taylor.hpp"

namespace casimir_kernel::taylor {

/// Storage for the recurrences of a straight-line program.
///
/// Every product, quotient and function of a series needs sums of l[j] r[k-j] over the earlier
/// coefficients of two series. The inner terms of these sums, j = 1 .. k-1, depend on no
/// coefficient of order k: all sums of the program are formed side by side, eight in a register,
/// before the rest of order k is done one operation after the other.
template <int the_states, int sums>
struct Convolved {
  using V = Lanes8;
  static constexpr int most = 24;  // the highest order
  static constexpr int states = the_states, blocks = (states + 7) / 8, groups = (sums + 7) / 8;
  static constexpr bool smooth = false;

  int order = most;
  V c[most + 1][blocks];
  V rate[blocks];

 protected:
  V left_[most][groups > 0 ? groups : 1], right_[most][groups > 0 ? groups : 1];
  double sum_[groups > 0 ? 8 * groups : 1];

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
      __builtin_memcpy(sum_ + 8 * g, &even, sizeof even);
    }
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  typename System::Series series;
  series.order = order_for(run);
  series.p = run->parameters;
  March<typename System::Series>(run, series, x, out).go();
}

}  // namespace casimir_kernel::taylor
