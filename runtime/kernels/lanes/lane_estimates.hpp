#pragma once

#include "runtime/kernels/lanes/lanes.hpp"

// Estimates of sizes in all lanes at once, no better than a step needs them.

namespace casimir_kernel::lanes {

template <class V>
inline constexpr int width_of = sizeof(V) / sizeof(double);
template <class V>
using Mask = Indices<width_of<V>>;

template <class V>
CASIMIR_INLINE Mask<V> bits_of(V v) {
  return (Mask<V>)v;
}

template <class V>
CASIMIR_INLINE V larger_of(V a, V b) {
  return a > b ? a : b;
}

/// log2 of positive numbers to within 0.01; -1023 for 0. No conversion of integers, which not every
/// instruction set has.
template <class V>
CASIMIR_INLINE V rough_log2(V a) {
  using Bits = Unsigned<width_of<V>>;
  const Bits bits = (Bits)a;
  const V exponent = (V)((bits >> 52) | 0x4330000000000000ULL) - (0x1p52 + 1023);
  const V m = (V)((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  return exponent + (m * (2 - m * (1. / 3)) - 5. / 3);
}

/// 2^a to within 1 %, for |a| < 1000.
template <class V>
CASIMIR_INLINE V rough_exp2(V a) {
  const V shifted = (a - 0.5) + 0x1.8p52;
  const V part = a - (shifted - 0x1.8p52);  // 0 .. 1
  const V power = (V)((bits_of(shifted) + 1023) << 52);
  return power * (1 + part * (0.6565 + 0.3435 * part));
}

/// 1/a to within 1 %, for normal positive a whose inverse is normal.
template <class V>
CASIMIR_INLINE V rough_inverse(V a) {
  const V guess = (V)(0x7fde623822fc16e6LL - bits_of(a));
  return guess * (2 - a * guess);
}

/// The power of two next to each positive number.
template <class V>
CASIMIR_INLINE V power_of_two_near(V a) {
  a = a > 0x1p-1020 ? a : all_lanes<V>(0x1p-1020);
  a = a < 0x1p1019 ? a : all_lanes<V>(0x1p1019);
  return (V)((bits_of(a) + 0x8000000000000LL) & 0x7ff0000000000000LL);
}

}  // namespace casimir_kernel::lanes
