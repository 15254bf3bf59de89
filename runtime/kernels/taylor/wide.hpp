#pragma once

#include "runtime/kernels/reciprocals.hpp"
#include "runtime/kernels/taylor/blocks.hpp"
#include "runtime/kernels/taylor/series.h"
#include "runtime/kernels/taylor/wide_tables.h"

namespace casimir_kernel::taylor {

/// Taylor coefficients of x' = constant + linear + quadratic, for states that fill `the_blocks`
/// registers and any number of products. The system is a table; nothing depends on it but counts
/// of loops.
///
/// The operands of the products stay in memory. Their convolutions are formed for four orders at a
/// time as far as the coefficients are known, so that a number that is loaded serves four sums;
/// what the four coefficients themselves add follows order by order.
///
/// What depends on the number of registers of products is chosen once. What steps along the series
/// is that of all systems (called_series.hpp).
/// \tparam few  registers of states, or 0 where there are more than CASIMIR_WIDE_BLOCKS.
template <int width, int few>
class Wide : Blocks<few, CASIMIR_WIDE_STATES / width> {
 public:
  explicit Wide(const casimir_wide& tables)
      : Registers(tables.blocks), c{rows_ + tables.blocks, tables.blocks}, tables_(tables) {
    choose_fixed();
  }

  /// Valid as long as this object is.
  casimir_series functions() {
    return {.states = tables_.states,
            .smooth = true,
            .direct = true,
            .registers = tables_.registers,
            .object = this,
            .rows = reinterpret_cast<double*>(rows_),
            .start = &start,
            .begin = &begin,
            .expand = &expand};
  }

 private:
  using Registers = Blocks<few, CASIMIR_WIDE_STATES / width>;
  using Registers::blocks, Registers::room;
  static constexpr int most = CASIMIR_SERIES_ORDER;
  using V = Lanes<width>;
  static constexpr int most_registers = CASIMIR_WIDE_PRODUCTS / width;

  static void start(void* object, int order, const double*) {
    static_cast<Wide*>(object)->order_ = order;
  }
  static void begin(void* object, double, const double* x) {
    Wide& self = *static_cast<Wide*>(object);
    (self.*self.begin_)(reinterpret_cast<const V*>(x));
  }
  static void expand(void* object, double unit) {
    Wide& self = *static_cast<Wide*>(object);
    (self.*self.expand_)(unit);
  }

  /// The coefficients 0, 1, .. of the factors.
  struct Product {
    V left[most], right[most];
  };

  void choose_fixed() {
    if constexpr (few > 0) {
      static_assert(CASIMIR_WIDE_FEW == 4);
      if (tables_.registers == 1) return choose<1>();
      if (tables_.registers == 2) return choose<2>();
      if (tables_.registers == 3) return choose<3>();
      if (tables_.registers == 4) return choose<4>();
    }
    choose<0>();
  }

  /// \tparam fixed  here and below, the number of registers of products where it is small: loops over
  ///                them are then written out, and sums of products stay in registers. 0: any
  ///                number.
  template <int fixed>
  void choose() {
    begin_ = &Wide::begin_with<fixed>;
    expand_ = &Wide::expand_with<fixed>;
    for (int m = 0; m < fixed; ++m)
      for (int b = 0; b < blocks; ++b)
        own_[m][b] = load<V>(tables_.dense + (m * blocks + b) * width);
  }

  template <int fixed>
  void begin_with(const V* x) {
    V state[room];
    for (int b = 0; b < blocks; ++b) state[b] = c[0][b] = x[b];
    rates_at<fixed>(state, 1);
    for (int b = 0; b < blocks; ++b) rows_[b] = state[b];
  }

  template <int fixed>
  void expand_with(double unit) {
    V x[room];  // the newest coefficient, which the next one waits for
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) x[b] = c[0][b];
    rates_at<fixed>(x, unit);
    store(1, x);
    next<fixed, true, 0>(1, unit, x);
    next<fixed, true, 1>(1, unit, x);
    next<fixed, true, 2>(1, unit, x);
    next<fixed, true, 3>(1, unit, x);
    for (int first = 5; first < order_; first += 4) {
      look_ahead<fixed>(first);
      next<fixed, false, 0>(first, unit, x);
      next<fixed, false, 1>(first, unit, x);
      next<fixed, false, 2>(first, unit, x);
      if (first + 3 < order_) next<fixed, false, 3>(first, unit, x);
    }
  }

  CASIMIR_INLINE void store(int k, const V* x) {
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) c[k][b] = x[b];
  }

  /// The states by the indices of a register: of coefficient k, which is x.
  CASIMIR_INLINE V operand(int k, const V* x, const long long* indices) const {
    return gathered<room>(gathers_in_registers<V, room> ? x : c[k], indices);
  }

  /// The state c[0], which is x, becomes its rates times a factor.
  template <int fixed>
  CASIMIR_INLINE void rates_at(V* x, double factor) {
    V own[fixed > 0 ? fixed : 1];
    each_register<fixed>([&](int m) CASIMIR_INLINE_LAMBDA {
      const V l = operand(0, x, tables_.left + m * width);
      const V r = operand(0, x, tables_.right + m * width);
      product_[m].left[0] = l;
      product_[m].right[0] = r;
      keep<fixed>(own, m, l * r);
    });
    combine<fixed>(own, 0, x);
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) x[b] = (x[b] + load<V>(tables_.constant + b * width)) * factor;
  }

  /// For m = 0 .. registers - 1.
  template <int fixed, class Action>
  CASIMIR_INLINE void each_register(Action action) const {
    if constexpr (fixed > 0) {
      CASIMIR_UNROLL
      for (int m = 0; m < fixed; ++m) action(m);
    } else {
      for (int m = 0; m < tables_.registers; ++m) action(m);
    }
  }

  /// The products of register m: in a register for their own lanes, in memory to be moved.
  template <int fixed>
  CASIMIR_INLINE void keep(V* own, int m, V value) {
    if constexpr (fixed > 0) own[m] = value;
    product_now_[m] = value;
  }

  /// What the coefficients before `first` give to the products of order first .. first + 3, except
  /// for coefficient 0. The latest of them on the right come last: so the sums of the others need
  /// not wait for them.
  template <int fixed>
  CASIMIR_INLINE void look_ahead(int first) {
    each_register<fixed>([&](int m) CASIMIR_INLINE_LAMBDA {
      const V* const l = product_[m].left;
      const V* const r = product_[m].right + first;
      V r1 = r[-1], r2 = r[-2], r3 = r[-3];
      V s0 = V{}, s1 = V{}, s2 = V{}, s3 = V{};
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
      // l[1] .. l[3] do not reach the later orders: there r is not known yet.
      s0 += (l[3] * r[-3] + l[2] * r[-2]) + l[1] * r[-1];
      s1 += l[3] * r[-2] + l[2] * r[-1];
      s2 += l[3] * r[-1];
      ahead_[m][0] = s0;
      ahead_[m][1] = s1;
      ahead_[m][2] = s2;
      ahead_[m][3] = s3;
    });
  }

  /// The inner terms of order k = first + q of register m: all without coefficient 0 and k.
  CASIMIR_INLINE V inner(int m, int first, int q) const {
    const Product& p = product_[m];
    V even = V{}, odd = V{};
    if (first == 1) {  // nothing was looked ahead
      CASIMIR_UNROLL
      for (int j = 1; j <= q; ++j) even += p.left[j] * p.right[q + 1 - j];
    } else {
      even = ahead_[m][q];
      CASIMIR_UNROLL
      for (int i = 0; i < q; ++i) {
        even += p.left[first + i] * p.right[q - i];
        odd += p.left[q - i] * p.right[first + i];
      }
    }
    return even + odd;
  }

  /// Coefficient k + 1 from coefficient k = first + q, which is x and becomes the new one.
  template <int fixed, bool at_start, int q>
  CASIMIR_INLINE void next(int first, double unit, V* x) {
    const int k = first + q;
    V own[fixed > 0 ? fixed : 1];
    each_register<fixed>([&](int m) CASIMIR_INLINE_LAMBDA {
      Product& p = product_[m];
      const V l = operand(k, x, tables_.left + m * width);
      const V r = operand(k, x, tables_.right + m * width);
      p.left[k] = l;
      p.right[k] = r;
      keep<fixed>(own, m, (inner(m, at_start ? 1 : first, q) + p.left[0] * r) + l * p.right[0]);
    });
    combine<fixed>(own, k, x);
    const double factor = unit * reciprocal.of[k + 1];
    const double lost = unit * reciprocal.rest[k + 1];
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b)
      x[b] = at_start || first < Reciprocals::felt ? x[b] * factor + x[b] * lost : x[b] * factor;
    store(k + 1, x);
  }

  /// The products of entry e, in the lanes where they are needed.
  CASIMIR_INLINE V moved(int e) const {
    const long long* const lanes = tables_.moved_lane + e * width;
    if constexpr (width == 2)
      return collected<V>(reinterpret_cast<const double*>(product_now_), lanes);
    else
      return permuted_by(product_now_[tables_.moved_from[e]], lanes);
  }

  /// What the products and coefficient k, which is x, make of the rates, which take its place;
  /// without the constants.
  template <int fixed>
  CASIMIR_INLINE void combine(const V* own, int k, V* x) {
    V rates[room];
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) {
      V even = V{}, odd = V{};
      for (int e = tables_.linear_begin[b]; e < tables_.linear_begin[b + 1]; ++e) {
        even += load<V>(tables_.linear_factor + e * width) *
                operand(k, x, tables_.linear_state + e * width);
      }
      if constexpr (fixed > 0) {
        CASIMIR_UNROLL
        for (int m = 0; m < fixed; ++m) (m % 2 ? odd : even) += own_[m][b] * own[m];
      } else {
        for (int e = tables_.own_begin[b]; e < tables_.own_begin[b + 1]; e += 2) {
          const double* const f = tables_.own_factor + e * width;
          even += load<V>(f) * product_now_[tables_.own_from[e]];
          odd += load<V>(f + width) * product_now_[tables_.own_from[e + 1]];
        }
      }
      for (int e = tables_.moved_begin[b]; e < tables_.moved_begin[b + 1]; e += 2) {
        const double* const f = tables_.moved_factor + e * width;
        even += load<V>(f) * moved(e);
        odd += load<V>(f + width) * moved(e + 1);
      }
      rates[b] = even + odd;
    }
    CASIMIR_UNROLL
    for (int b = 0; b < blocks; ++b) x[b] = rates[b];
  }

  V rows_[(most + 2) * room];
  const Rows<V, few> c;
  int order_ = 0;
  const casimir_wide tables_;
  void (Wide::*begin_)(const V* x);
  void (Wide::*expand_)(double unit);
  V own_[CASIMIR_WIDE_FEW][room];  // the factors of `dense`
  V ahead_[most_registers][4];
  V product_now_[most_registers];
  Product product_[most_registers];
};

}  // namespace casimir_kernel::taylor
