#pragma once

#include "runtime/kernels/reciprocals.hpp"
#include "runtime/kernels/taylor.hpp"
#include "runtime/kernels/wide_tables.h"

namespace casimir_kernel::taylor {

/// Taylor coefficients of x' = constant + linear + quadratic, for states that fill `the_blocks`
/// registers and any number of products. The system is a table; nothing depends on it but counts
/// of loops.
///
/// The operands of the products stay in memory. Their convolutions are formed for four orders at a
/// time as far as the coefficients are known, so that a number that is loaded serves four sums;
/// what the four coefficients themselves add follows order by order.
template <int width, int the_blocks>
struct Wide {
  using V = Lanes<width>;
  using Index = Indices<width>;
  static constexpr int blocks = the_blocks, room = blocks, most = 24;
  static constexpr bool smooth = true, prepared = false;

  const int states, order;
  V c[most + 1][blocks];
  V rate[blocks];

  Wide(const casimir_wide& tables, int the_order)
      : states(tables.states), order(the_order), tables_(tables), registers_(tables.registers) {}

  __attribute__((noinline)) void begin(double, const V* x) {
    alignas(V) V state[blocks];
    for (int b = 0; b < blocks; ++b) state[b] = x[b];
    multiply(state);
    combine(state, true, 1, rate);
  }

  void expand(double unit) {
    V x[blocks];  // the newest coefficient, which the next one waits for
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) x[b] = c[0][b];
    multiply(x);
    combine(x, true, unit, c[1]);
    next<true, 0>(1, unit, x);
    next<true, 1>(1, unit, x);
    next<true, 2>(1, unit, x);
    next<true, 3>(1, unit, x);
    for (int first = 5; first < order; first += 4) {
      look_ahead(first);
      next<false, 0>(first, unit, x);
      next<false, 1>(first, unit, x);
      next<false, 2>(first, unit, x);
      if (first + 3 < order) next<false, 3>(first, unit, x);
    }
  }

 private:
  static constexpr int most_registers = CASIMIR_WIDE_PRODUCTS / width;

  /// The coefficients 0, 1, .. of the factors.
  struct Product {
    V left[most], right[most];
  };

  /// The factors in register m of coefficient k, which is x.
  CASIMIR_INLINE V operand(int k, const V* x, const long long* indices, int m) const {
    return gathered<blocks>(width == 8 ? x : c[k], indices + m * width);
  }

  /// The products of a state.
  CASIMIR_INLINE void multiply(const V* x) {
    for (int m = 0; m < registers_; ++m) {
      const V l = gathered<blocks>(x, tables_.left + m * width);
      const V r = gathered<blocks>(x, tables_.right + m * width);
      product_[m].left[0] = l;
      product_[m].right[0] = r;
      source_[m] = l * r;
    }
  }

  /// What the coefficients before `first` give to the products of order first .. first + 3, except
  /// for coefficient 0.
  CASIMIR_INLINE void look_ahead(int first) {
    for (int m = 0; m < registers_; ++m) {
      const V* const l = product_[m].left;
      const V* r = product_[m].right + first;
      // l[1] .. l[3] do not reach the later orders: there r is not known yet.
      V s0 = l[1] * r[-1] + l[2] * r[-2] + l[3] * r[-3];
      V s1 = l[2] * r[-1] + l[3] * r[-2];
      V s2 = l[3] * r[-1];
      V s3 = V{};
      V r1 = r[-1], r2 = r[-2], r3 = r[-3];
      for (int j = 4; j < first; ++j) {
        const V a = l[j], r4 = r[-j];
        s0 += a * r4;
        s1 += a * r3;
        s2 += a * r2;
        s3 += a * r1;
        r1 = r2;
        r2 = r3;
        r3 = r4;
      }
      ahead_[m][0] = s0;
      ahead_[m][1] = s1;
      ahead_[m][2] = s2;
      ahead_[m][3] = s3;
    }
  }

  /// Coefficient k + 1 from coefficient k = first + q. At the start nothing was looked ahead.
  template <bool at_start, int q>
  CASIMIR_INLINE void next(int first, double unit, V* x) {
    const int k = first + q;
    for (int m = 0; m < registers_; ++m) {
      Product& p = product_[m];
      const V l = operand(k, x, tables_.left, m), r = operand(k, x, tables_.right, m);
      p.left[k] = l;
      p.right[k] = r;
      V known = V{};
      if constexpr (at_start) {
        CASIMIR_UNROLL
        for (int j = 1; j <= q; ++j) known += p.left[j] * p.right[q + 1 - j];
      } else {
        known = ahead_[m][q];
        CASIMIR_UNROLL
        for (int i = 0; i < q; ++i) {
          known += p.left[first + i] * p.right[q - i];
          known += p.left[q - i] * p.right[first + i];
        }
      }
      source_[m] = (known + p.left[0] * r) + l * p.right[0];
    }
    combine(x, false, unit * reciprocal.of[k + 1], c[k + 1]);
  }

  CASIMIR_INLINE V moved(int e) const {
    if constexpr (width == 8)
      return permuted(source_[tables_.moved_source[e]], load<Index>(tables_.moved_from + e * width));
    else
      return collected<V>(reinterpret_cast<const double*>(source_), tables_.moved_from + e * width);
  }

  /// The rates that the products in `source_` and a state make, times a factor.
  CASIMIR_INLINE void combine(V* x, bool with_constant, double factor, V* rates) {
    if (tables_.linear) {
      CASIMIR_UNROLL
      for (int b = 0; b < blocks; ++b) source_[registers_ + b] = x[b];
    }
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) {
      V even = V{}, odd = V{};
      if (with_constant) even = load<V>(tables_.constant + b * width);
      for (int e = tables_.own_begin[b]; e < tables_.own_begin[b + 1]; e += 2) {
        const double* const f = tables_.own_factor + e * width;
        even += load<V>(f) * source_[tables_.own_source[e]];
        odd += load<V>(f + width) * source_[tables_.own_source[e + 1]];
      }
      for (int e = tables_.moved_begin[b]; e < tables_.moved_begin[b + 1]; e += 2) {
        const double* const f = tables_.moved_factor + e * width;
        even += load<V>(f) * moved(e);
        odd += load<V>(f + width) * moved(e + 1);
      }
      x[b] = (even + odd) * factor;
      rates[b] = x[b];
    }
  }

  const casimir_wide& tables_;
  const int registers_;
  V ahead_[most_registers][4];
  V source_[most_registers + blocks];
  Product product_[most_registers];
};

}  // namespace casimir_kernel::taylor
