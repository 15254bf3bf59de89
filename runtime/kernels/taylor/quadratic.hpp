#pragma once

#include "runtime/kernels/reciprocals.hpp"
#include "runtime/kernels/taylor/quadratic_tables.h"
#include "runtime/kernels/taylor/taylor.hpp"

namespace casimir_kernel::taylor {

/// Taylor coefficients of x' = constant + linear + quadratic for up to `width` states, with the
/// products of the right-hand side in the lanes of `registers` registers.
///
/// The sums of products that coefficient k+1 needs consist of those with coefficient 0, which are
/// the Jacobian at the state applied to coefficient k, and of the inner ones. As soon as a
/// coefficient is known its inner products go into the sums of all orders they belong to, so the
/// sums stay in registers, and of a new coefficient only the Jacobian is left to do.
///
/// Tables is a class with a casimir_quadratic `tables`, `static constexpr bool known`, and the
/// counts in the tables as functions `diagonals`, `parts` and `moves`: constants where they are
/// known, so that the loops are written out.
template <class Tables, int width, int registers, int the_order>
struct Quadratic : Tables {
  using V = Lanes<width>;
  using Index = Indices<width>;
  static constexpr int blocks = 1, room = 1, order = the_order;
  using Tables::tables;
  static constexpr bool smooth = true, prepared = false;

  V c[order + 1][1];
  V rate[1];

  const int states = tables.states;

  explicit Quadratic(const Tables& from = {}) : Tables(from) {}

  __attribute__((noinline)) void begin(double, const V* x) {
    rate[0] = at<V>(tables.constant);
    for (int d = 0; d < Tables::diagonals(tables); ++d)
      rate[0] += (jacobian(d, x[0]) + at<V>(tables.fixed[d])) * 0.5 *
                 permuted(x[0], at<Index>(tables.column[d]));
  }

  CASIMIR_INLINE void expand(double unit) {
    V diagonal[CASIMIR_MOST_DIAGONALS], own[registers], factor[registers][width];
    const V x = c[0][0];
    V first = at<V>(tables.constant) * unit;
    repeat(Tables::diagonals(tables), [&](int d) CASIMIR_INLINE_LAMBDA {
      diagonal[d] = jacobian(d, x) * unit;
      first += (diagonal[d] + at<V>(tables.fixed[d]) * unit) * 0.5 *
               permuted(x, at<Index>(tables.column[d]));
    });
    CASIMIR_UNROLL
    for (int m = 0; m < registers; ++m) {
      own[m] = at<V>(tables.own[m]) * unit;
      repeat(Tables::moves(tables, m), [&](int e) CASIMIR_INLINE_LAMBDA {
        factor[m][e] = at<V>(tables.move[m][e].factor) * unit;
      });
    }
    c[1][0] = first;
    V left[order][registers], right[order][registers], sum[order][registers];
    next<1>(diagonal, own, factor, left, right, sum);
  }

 private:
  template <class T>
  static CASIMIR_INLINE T at(const void* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }

  /// For i = 0 .. count - 1, written out where the count is known.
  template <class Action>
  static CASIMIR_INLINE void repeat(int count, Action action) {
    if constexpr (Tables::known) {
#pragma GCC unroll 8
      for (int i = 0; i < count; ++i) action(i);
    } else {
      for (int i = 0; i < count; ++i) action(i);
    }
  }

  CASIMIR_INLINE V jacobian(int d, V x) const {
    V entries = at<V>(tables.fixed[d]);
    repeat(Tables::parts(tables, d), [&](int q) CASIMIR_INLINE_LAMBDA {
      const casimir_move& part = tables.part[d][q];
      entries += at<V>(part.factor) * permuted(x, at<Index>(part.from));
    });
    return entries;
  }

  /// Coefficient k+1 and all after it.
  template <int k>
  CASIMIR_INLINE void next(const V* diagonal, const V* own, const V (*factor)[width],
                           V (*left)[registers], V (*right)[registers], V (*sum)[registers]) {
    const V x = c[k][0];
    constexpr double part = 1. / (k + 1);
    V inner = V{};
    if constexpr (k > 1) {
      CASIMIR_UNROLL
      for (int m = 0; m < registers; ++m) {
        const V total = sum[k][m];
        inner += own[m] * total;
        repeat(Tables::moves(tables, m), [&](int e) CASIMIR_INLINE_LAMBDA {
          inner += factor[m][e] * permuted(total, at<Index>(tables.move[m][e].from));
        });
      }
    }
    // Two chains: this is what the next coefficient waits for.
    V other = V{};
    repeat(Tables::diagonals(tables) / 2, [&](int pair) CASIMIR_INLINE_LAMBDA {
      const int d = 2 * pair;
      inner += diagonal[d] * permuted(x, at<Index>(tables.column[d]));
      other += diagonal[d + 1] * permuted(x, at<Index>(tables.column[d + 1]));
    });
    // A rounded 1/(k+1) would err in the same direction at every step, and a million steps add up.
    constexpr double lost = k < Reciprocals::felt ? reciprocal.rest[k + 1] : 0;
    const V rate = inner + other;
    c[k + 1][0] = lost == 0 ? rate * part : rate * part + rate * lost;
    if constexpr (k + 1 < order) {
      push<k>(x, left, right, sum);
      next<k + 1>(diagonal, own, factor, left, right, sum);
    }
  }

  /// The products of coefficient k with those of 1 .. k.
  template <int k>
  CASIMIR_INLINE void push(V x, V (*left)[registers], V (*right)[registers], V (*sum)[registers]) {
    CASIMIR_UNROLL
    for (int m = 0; m < registers; ++m) {
      const V l = permuted(x, at<Index>(tables.left[m]));
      const V r = permuted(x, at<Index>(tables.right[m]));
      left[k][m] = l;
      right[k][m] = r;
#pragma GCC unroll 32
      for (int j = 1; j <= k && k + j < order; ++j) {
        if (j == k)
          sum[2 * k][m] = l * r;
        else if (j == k - 1)
          sum[2 * k - 1][m] = left[j][m] * r + right[j][m] * l;
        else  // one fused operation after the other
          sum[k + j][m] = right[j][m] * l + (left[j][m] * r + sum[k + j][m]);
      }
    }
  }
};

}  // namespace casimir_kernel::taylor
