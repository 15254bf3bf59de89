#pragma once

// Several numbers in one register, by the vector extensions of GCC and Clang.

#include "runtime/kernels/inline.hpp"
#include "runtime/kernels/unroll.hpp"
#include "runtime/module_abi.h"

namespace casimir_kernel {

template <int width>
struct LaneTypes;
template <>
struct LaneTypes<2> {
  typedef double Real __attribute__((vector_size(16)));
  typedef long long Index __attribute__((vector_size(16)));
  typedef unsigned long long Unsigned __attribute__((vector_size(16)));
};
template <>
struct LaneTypes<4> {
  typedef double Real __attribute__((vector_size(32)));
  typedef long long Index __attribute__((vector_size(32)));
  typedef unsigned long long Unsigned __attribute__((vector_size(32)));
};
template <>
struct LaneTypes<8> {
  typedef double Real __attribute__((vector_size(64)));
  typedef long long Index __attribute__((vector_size(64)));
  typedef unsigned long long Unsigned __attribute__((vector_size(64)));
};

/// `width` numbers: 2, 4 or 8.
template <int width>
using Lanes = typename LaneTypes<width>::Real;
template <int width>
using Indices = typename LaneTypes<width>::Index;
template <int width>
using Unsigned = typename LaneTypes<width>::Unsigned;
/// What one register of this instruction set holds.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
constexpr int kNativeWidth = 8;
#elif defined(__AVX2__) && defined(__FMA__)
constexpr int kNativeWidth = 4;
#else
constexpr int kNativeWidth = 2;
#endif
using Lanes2 = Lanes<2>;
using Lanes4 = Lanes<4>;
using Lanes8 = Lanes<8>;

template <class V>
CASIMIR_INLINE V all_lanes(double a) {
  return a - V{};
}

CASIMIR_INLINE Lanes2 absolute(Lanes2 v) { return (Lanes2)((Indices<2>)v & 0x7fffffffffffffffLL); }
CASIMIR_INLINE Lanes4 absolute(Lanes4 v) { return (Lanes4)((Indices<4>)v & 0x7fffffffffffffffLL); }
CASIMIR_INLINE Lanes8 absolute(Lanes8 v) { return (Lanes8)((Indices<8>)v & 0x7fffffffffffffffLL); }

/// The sum of the lanes: not a number if any lane is none.
CASIMIR_INLINE double lane_sum(Lanes2 v) { return v[0] + v[1]; }
CASIMIR_INLINE double lane_sum(Lanes4 v) { return (v[0] + v[2]) + (v[1] + v[3]); }
CASIMIR_INLINE double lane_sum(Lanes8 v) {
  const Lanes4 low = __builtin_shufflevector(v, v, 0, 1, 2, 3);
  const Lanes4 high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return lane_sum(low + high);
}

/// Writes the sums of the lanes of four registers.
CASIMIR_INLINE void lane_sums(Lanes2 a, Lanes2 b, Lanes2 c, Lanes2 d, double* sums) {
  const Lanes2 ab = __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
  const Lanes2 cd = __builtin_shufflevector(c, d, 0, 2) + __builtin_shufflevector(c, d, 1, 3);
  __builtin_memcpy(sums, &ab, sizeof ab);
  __builtin_memcpy(sums + 2, &cd, sizeof cd);
}
CASIMIR_INLINE void lane_sums(Lanes4 a, Lanes4 b, Lanes4 c, Lanes4 d, double* sums) {
  const Lanes4 ab =
      __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes4 cd =
      __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Lanes4 all =
      __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  __builtin_memcpy(sums, &all, sizeof all);
}
CASIMIR_INLINE void lane_sums(Lanes8 a, Lanes8 b, Lanes8 c, Lanes8 d, double* sums) {
  const auto half = [](Lanes8 v) CASIMIR_INLINE_LAMBDA {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  };
  lane_sums(half(a), half(b), half(c), half(d), sums);
}

/// Whether any lane of a mask is set.
CASIMIR_INLINE bool any(Indices<2> mask) { return (mask[0] | mask[1]) != 0; }
CASIMIR_INLINE bool any(Indices<4> mask) {
  return any(__builtin_shufflevector(mask, mask, 0, 1) | __builtin_shufflevector(mask, mask, 2, 3));
}
CASIMIR_INLINE bool any(Indices<8> mask) {
  return any(__builtin_shufflevector(mask, mask, 0, 1, 2, 3) |
             __builtin_shufflevector(mask, mask, 4, 5, 6, 7));
}

#ifdef __clang__
template <class V, class I>
CASIMIR_INLINE V permuted_one_by_one(V v, I from) {
  V result = v;
  for (unsigned i = 0; i < sizeof(V) / sizeof(double); ++i) result[i] = v[from[i]];
  return result;
}
#endif

/// Lane i of the result is lane from[i] of v. The indices are in range.
CASIMIR_INLINE Lanes4 permuted(Lanes4 v, Indices<4> from) {
#ifdef __AVX512VL__  // GCC has a slower instruction for this
  asm("vpermpd %2, %1, %0" : "=v"(v) : "v"(from), "v"(v));
  return v;
#elif defined __clang__
  return permuted_one_by_one(v, from);
#else
  return __builtin_shuffle(v, from);
#endif
}
CASIMIR_INLINE Lanes8 permuted(Lanes8 v, Indices<8> from) {
#ifdef __AVX512F__
  asm("vpermpd %2, %1, %0" : "=v"(v) : "v"(from), "v"(v));
  return v;
#elif defined __clang__
  return permuted_one_by_one(v, from);
#else  // two registers, each filled from both halves
  const Lanes4 low = __builtin_shufflevector(v, v, 0, 1, 2, 3);
  const Lanes4 high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const Lanes4 first =
      __builtin_shuffle(low, high, __builtin_shufflevector(from, from, 0, 1, 2, 3));
  const Lanes4 last = __builtin_shuffle(low, high, __builtin_shufflevector(from, from, 4, 5, 6, 7));
  return __builtin_shufflevector(first, last, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

template <class V>
CASIMIR_INLINE V load(const void* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

/// Lane i of the result is the number from[i] behind `x`.
template <class V>
CASIMIR_INLINE V collected(const double* x, const long long* from) {
  if constexpr (sizeof(V) == sizeof(Lanes2)) {
    return V{x[from[0]], x[from[1]]};
  } else if constexpr (sizeof(V) == sizeof(Lanes4)) {
    return V{x[from[0]], x[from[1]], x[from[2]], x[from[3]]};
  } else {
    return V{x[from[0]], x[from[1]], x[from[2]], x[from[3]],
             x[from[4]], x[from[5]], x[from[6]], x[from[7]]};
  }
}

/// Whether `gathered` moves lanes between registers, rather than loading one number after another.
template <class V, int blocks>
constexpr bool gathers_in_registers =
#if defined(__AVX512F__)
    sizeof(V) == sizeof(Lanes8) && blocks <= 3;
#elif defined(__AVX2__)
    sizeof(V) == sizeof(Lanes4) && blocks <= 3;
#else
    false;
#endif

/// Lane i of the result is lane from[i] of v. The indices are in the form that the instruction set
/// moves by: for four lanes, the lane n is 2n and 2n + 1 in the halves, as for numbers of half the
/// size. Not for two lanes.
CASIMIR_INLINE Lanes4 permuted_by(Lanes4 v, const long long* from) {
#ifdef __AVX2__
  typedef float Halves __attribute__((vector_size(32)));
  typedef int GridPoints __attribute__((vector_size(32)));
  return (Lanes4)__builtin_ia32_permvarsf256((Halves)v, load<GridPoints>(from));
#else
  return Lanes4{v[from[0] >> 1 & 3], v[from[1] >> 1 & 3], v[from[2] >> 1 & 3], v[from[3] >> 1 & 3]};
#endif
}
CASIMIR_INLINE Lanes8 permuted_by(Lanes8 v, const long long* from) {
  return permuted(v, load<Indices<8>>(from));
}

/// Lane i of the result is the number from[i] in `blocks` registers. For at most three registers of
/// four, the indices are those of `permuted_by` in the register, bit 63 is set for the second
/// register and bit 62 for the third.
template <int blocks, class V>
CASIMIR_INLINE V gathered(const V* x, const long long* from) {
#if defined(__AVX512F__) && !defined(__clang__)
  if constexpr (gathers_in_registers<V, blocks>) {
    const Indices<8> lanes = load<Indices<8>>(from);
    if constexpr (blocks == 1) return permuted(x[0], lanes);
    if constexpr (blocks == 2) return __builtin_shuffle(x[0], x[1], lanes);
    if constexpr (blocks == 3) {
      const V low = __builtin_shuffle(x[0], x[1], lanes), high = permuted(x[2], lanes);
      return lanes < 16 ? low : high;
    }
  }
#elif defined(__AVX2__) && !defined(__clang__)
  if constexpr (gathers_in_registers<V, blocks>) {
    const V low = permuted_by(x[0], from);
    if constexpr (blocks == 1) return low;
    const V both = __builtin_ia32_blendvpd256(low, permuted_by(x[blocks > 1], from), load<V>(from));
    if constexpr (blocks == 2) return both;
    return __builtin_ia32_blendvpd256(both, permuted_by(x[blocks - 1], from),
                                      (V)(load<Indices<4>>(from) << 1));
  }
#endif
  return collected<V>(reinterpret_cast<const double*>(x), from);
}

}  // namespace casimir_kernel
