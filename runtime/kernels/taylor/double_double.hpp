#pragma once

#if defined(__FMA__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "runtime/kernels/lanes/lanes.hpp"

// Sums of two numbers, in each lane of a register: about 32 digits. For precompiled kernels only,
// and only where products and sums are not fused behind the program's back (-ffp-contract=off).
//
// Dekker, Numer. Math. 18 (1971) 224; Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44
// (2017) 15.
namespace casimir_kernel {

#if defined(__FMA__)
CASIMIR_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) {
  return (Lanes2)_mm_fmadd_pd((__m128d)a, (__m128d)b, (__m128d)c);
}
CASIMIR_INLINE Lanes4 fused(Lanes4 a, Lanes4 b, Lanes4 c) {
  return (Lanes4)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
}
#endif
#if defined(__AVX512F__)
CASIMIR_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) {
  return (Lanes8)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
}
#endif

/// high + low, where low is at most half a unit in the last place of high.
template <class V>
struct DoubleDouble {
  V high, low;
};

/// a + b without error, for |a| >= |b| or a = 0.
template <class V>
CASIMIR_INLINE DoubleDouble<V> fast_sum(V a, V b) {
  const V sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b without error.
template <class V>
CASIMIR_INLINE DoubleDouble<V> exact_sum(V a, V b) {
  const V sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a * b without error, but for underflow.
template <class V>
CASIMIR_INLINE DoubleDouble<V> exact_product(V a, V b) {
  const V product = a * b;
#if defined(__FMA__) || defined(__AVX512F__)
  return {product, fused(a, b, -product)};
#else
  constexpr double kSplit = 0x1p27 + 1;
  const V a1 = a * kSplit, b1 = b * kSplit;
  const V ah = a1 - (a1 - a), bh = b1 - (b1 - b), al = a - ah, bl = b - bh;
  return {product, ((ah * bh - product) + (ah * bl + al * bh)) + al * bl};
#endif
}

template <class V>
CASIMIR_INLINE DoubleDouble<V> operator*(DoubleDouble<V> a, DoubleDouble<V> b) {
  const DoubleDouble<V> p = exact_product(a.high, b.high);
  return fast_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/// a * b, of which low may be some units in the last place of high: for `Sum`.
template <class V>
CASIMIR_INLINE DoubleDouble<V> loose_product(DoubleDouble<V> a, DoubleDouble<V> b) {
  const DoubleDouble<V> p = exact_product(a.high, b.high);
  return {p.high, p.low + (a.high * b.low + a.low * b.high)};
}

/// A sum in which the next term waits for one addition only: what the others lose is collected
/// apart (Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26 (2005) 1955). Its low part may be some units
/// in the last place of high; the error is relative to the largest term.
template <class V>
struct Sum : DoubleDouble<V> {
  CASIMIR_INLINE void add(DoubleDouble<V> term) {
    const DoubleDouble<V> sum = exact_sum(this->high, term.high);
    this->high = sum.high;
    this->low += sum.low + term.low;
  }
};

template <class V>
CASIMIR_INLINE DoubleDouble<V> operator*(DoubleDouble<V> a, V b) {
  const DoubleDouble<V> p = exact_product(a.high, b);
  return fast_sum(p.high, p.low + a.low * b);
}

/// The error is relative to the larger of a and b, not to their sum.
template <class V>
CASIMIR_INLINE DoubleDouble<V> operator+(DoubleDouble<V> a, DoubleDouble<V> b) {
  const DoubleDouble<V> sum = exact_sum(a.high, b.high);
  return fast_sum(sum.high, sum.low + (a.low + b.low));
}

}  // namespace casimir_kernel
