#pragma once

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/unroll.hpp"

// What the method of Taylor series makes of the coefficients of one trajectory: their sums along a
// step, and estimates of sizes that need be no better than a step is.

namespace casimir_kernel::taylor {

/// log2 of a positive number to within 0.01; -1023 for 0.
CASIMIR_INLINE double rough_log2(double a) {
  long long bits;
  __builtin_memcpy(&bits, &a, sizeof bits);
  const double exponent = static_cast<double>((bits >> 52) - 1023);
  bits = (bits & 0xfffffffffffffLL) | 0x3ff0000000000000LL;
  double m;
  __builtin_memcpy(&m, &bits, sizeof m);
  return exponent + (m * (2 - m * (1. / 3)) - 5. / 3);
}

/// 2^a to within 1 %, for |a| < 1000.
CASIMIR_INLINE double rough_exp2(double a) {
  const long long whole = static_cast<long long>(a + 2048) - 2048;
  const double part = a - static_cast<double>(whole);
  const long long bits = (whole + 1023) << 52;
  double power;
  __builtin_memcpy(&power, &bits, sizeof power);
  return power * (1 + part * (0.6565 + 0.3435 * part));
}

/// The power of two next to a positive number.
inline double power_of_two_near(double a) {
  double power = 1;
  long long bits;
  __builtin_memcpy(&bits, &a, sizeof bits);
  bits = (bits + 0x8000000000000LL) & 0x7ff0000000000000LL;
  if (bits > 0x0030000000000000LL && bits < 0x7fd0000000000000LL)
    __builtin_memcpy(&power, &bits, sizeof power);
  else
    power = bits > 0x3ff0000000000000LL ? 0x1p1020 : 0x1p-1020;
  return power;
}

/// sum of c[k] s^k, k = 1 .. order: four chains, so that the processor need not wait for each.
template <class Series, class V>
CASIMIR_INLINE void increment(const Series& series, double s, V* sum) {
  const int blocks = series.blocks;
  const V s1 = all_lanes<V>(s), s2 = s1 * s1, s4 = s2 * s2;
  CASIMIR_UNROLL
  for (int b = 0; b < blocks; ++b) {
    const auto* c = &series.c[series.order - 3][b];
    V p0 = c[0], p1 = c[blocks], p2 = c[2 * blocks], p3 = c[3 * blocks];
    CASIMIR_UNROLL
    for (int k = series.order - 4; k > 0; k -= 4) {
      c -= 4 * blocks;
      p0 = p0 * s4 + c[0];
      p1 = p1 * s4 + c[blocks];
      p2 = p2 * s4 + c[2 * blocks];
      p3 = p3 * s4 + c[3 * blocks];
    }
    sum[b] = ((p0 + p1 * s1) + (p2 + p3 * s1) * s2) * s1;
  }
}

/// sum of c[k] s^(k - first), k = first .. order, where first = CASIMIR_LEADING + 1.
template <class Series, class V>
CASIMIR_INLINE void tail(const Series& series, double s, V* sum) {
  static_assert(CASIMIR_LEADING == 2);
  const int blocks = series.blocks;
  const V s1 = all_lanes<V>(s), s2 = s1 * s1, s4 = s2 * s2;
  CASIMIR_UNROLL
  for (int b = 0; b < blocks; ++b) {
    V p0 = V{}, p1 = V{}, p2 = V{}, p3 = V{};
    for (int k = series.order - 3; k > 4; k -= 4) {
      const auto* c = &series.c[k][b];
      p0 = p0 * s4 + c[0];
      p1 = p1 * s4 + c[blocks];
      p2 = p2 * s4 + c[2 * blocks];
      p3 = p3 * s4 + c[3 * blocks];
    }
    const V from_5 = (p0 + p1 * s1) + (p2 + p3 * s1) * s2;
    sum[b] = series.c[3][b] + (series.c[4][b] + from_5 * s1) * s1;
  }
}

/// sum of k c[k] s^k: the derivative of the series, times s.
template <class Series, class V>
CASIMIR_INLINE void slope(const Series& series, double s, V* sum) {
  const int blocks = series.blocks;
  const V s1 = all_lanes<V>(s), s2 = s1 * s1, s4 = s2 * s2;
  CASIMIR_UNROLL
  for (int b = 0; b < blocks; ++b) {
    V p0 = V{}, p1 = V{}, p2 = V{}, p3 = V{};
    for (int k = series.order - 3; k > 0; k -= 4) {
      const auto* c = &series.c[k][b];
      p0 = p0 * s4 + c[0] * k;
      p1 = p1 * s4 + c[blocks] * (k + 1);
      p2 = p2 * s4 + c[2 * blocks] * (k + 2);
      p3 = p3 * s4 + c[3 * blocks] * (k + 3);
    }
    sum[b] = ((p0 + p1 * s1) + (p2 + p3 * s1) * s2) * s1;
  }
}

}  // namespace casimir_kernel::taylor
