#pragma once

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/reciprocals.hpp"

namespace casimir_kernel::taylor {

/// Storage for the recurrences of a straight-line program.
///
/// Every product, quotient and function of a series needs sums of l[j] r[k-j] over the earlier
/// coefficients of two series. They are formed side by side in the lanes of registers, before the
/// rest of order k is done one operation after the other. Packed into registers, all wait for the
/// last coefficient of order k-1.
///
/// Where there are few, that is most of the time of an order. Then their terms j = 2 .. k-2 alone
/// are formed so, one order before, while the processor waits for other things; what the newest
/// coefficients add follows for each sum by itself, as soon as both are there.
///
/// Only the recurrences are compiled for each system: what steps along the series is precompiled
/// (called_series.hpp) and finds `rate` and `c` at the beginning.
/// \tparam few  whether the newest coefficients are added to each sum by itself.
template <int the_states, int sums, bool few>
struct Convolved {
  static constexpr int width = kNativeWidth;
  using V = Lanes<width>;
  static constexpr int most = 24;  // the highest order
  static constexpr int states = the_states, blocks = (states + width - 1) / width;
  /// Registers of four leave an execution unit to what is not in registers of eight.
  static constexpr int sums_width = few && width > 4 ? 4 : width;
  using S = Lanes<sums_width>;
  static constexpr int groups = sums > 0 ? (sums + sums_width - 1) / sums_width : 1;

  V rate[blocks];
  V c[most + 1][blocks];
  int order;
  const double* p;

 protected:
  static constexpr int kAtOnce = 4;
  S left_[most + kAtOnce][groups], right_[most + kAtOnce][groups];
  double formed_[sums_width * groups], first_left_[sums_width * groups],
      first_right_[sums_width * groups];

  static CASIMIR_INLINE double lane(const V* x, int i) { return x[i / width][i % width]; }

  /// The numbers, side by side, in as many registers as they need.
  template <class Register, class... Numbers>
  static CASIMIR_INLINE void pack(Register* to, Numbers... numbers) {
    constexpr int room = sizeof(Register) / sizeof(double);
    const double all[(sizeof...(numbers) + room - 1) / room * room] = {numbers...};
    fill<0>(to, all);
  }

  template <class... Numbers>
  static CASIMIR_INLINE void store(double* to, Numbers... numbers) {
    ((*to++ = numbers), ...);
  }

  /// All terms of order k of every sum.
  CASIMIR_INLINE void form_sums(int k) {
    CASIMIR_UNROLL
    for (int g = 0; g < groups; ++g) {
      S even = S{}, odd = S{};
      int j = 1;
      for (; j + 1 < k; j += 2) {
        even += left_[j][g] * right_of(k - j)[g];
        odd += left_[j + 1][g] * right_of(k - j - 1)[g];
      }
      if (j < k) even += left_[j][g] * right_of(k - j)[g];
      even += odd;
      __builtin_memcpy(formed_ + sums_width * g, &even, sizeof even);
    }
  }

  /// No coefficients yet, for `form_inner`.
  CASIMIR_INLINE void clear_operands() {
    for (auto& row : left_)
      for (int g = 0; g < groups; ++g) row[g] = S{};
    for (int k = 0; k < kAtOnce; ++k)
      for (int g = 0; g < groups; ++g) right_[k][g] = S{};
  }

  /// The terms j = 2 .. k-2 of order k of every sum, four at once: a loop that ends elsewhere at
  /// every order is not foreseen by the processor, which then cannot run ahead. Behind the last
  /// term stand operands that are zero yet.
  CASIMIR_INLINE void form_inner(int k) {
    S even[groups] = {}, odd[groups] = {};
    for (int j = 2; j + 1 < k; j += kAtOnce) {
      CASIMIR_UNROLL
      for (int g = 0; g < groups; ++g) {
        even[g] += left_[j][g] * right_of(k - j)[g];
        odd[g] += left_[j + 1][g] * right_of(k - j - 1)[g];
        even[g] += left_[j + 2][g] * right_of(k - j - 2)[g];
        odd[g] += left_[j + 3][g] * right_of(k - j - 3)[g];
      }
    }
    CASIMIR_UNROLL
    for (int g = 0; g < groups; ++g) {
      even[g] += odd[g];
      __builtin_memcpy(formed_ + sums_width * g, &even[g], sizeof even[g]);
    }
  }

  CASIMIR_INLINE S* right_of(int k) { return right_[k + kAtOnce - 1]; }

 private:
  template <int b, class Register, int count>
  static CASIMIR_INLINE void fill(Register* to, const double (&all)[count]) {
    static constexpr long long lanes[] = {0, 1, 2, 3, 4, 5, 6, 7};
    constexpr int room = sizeof(Register) / sizeof(double);
    to[b] = collected<Register>(all + b * room, lanes);
    if constexpr ((b + 1) * room < count) fill<b + 1>(to, all);
  }
};

}  // namespace casimir_kernel::taylor
