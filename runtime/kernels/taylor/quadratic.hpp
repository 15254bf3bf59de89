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
/// What depends on the number of registers is chosen once, so that the march over the steps is
/// compiled for each width and order only.
template <int width, int the_order>
class Quadratic {
 public:
  using V = Lanes<width>;
  using Index = Indices<width>;
  static constexpr int blocks = 1, room = 1, order = the_order;
  static constexpr bool smooth = true, prepared = false;
  /// Most registers of products: four states have ten products.
  static constexpr int most = width == 4 ? 3 : CASIMIR_MOST_PRODUCTS;

  V c[order + 1][1];
  V rate[1];

  const int states;

  explicit Quadratic(const casimir_quadratic& tables) : states(tables.states), tables_(tables) {
    choose<1>();
  }

  __attribute__((noinline)) void begin(double, const V* x) {
    rate[0] = at<V>(tables_.constant);
    for (int d = 0; d < tables_.diagonals; ++d)
      rate[0] += (jacobian(d, x[0]) + at<V>(tables_.fixed[d])) * 0.5 *
                 permuted(x[0], at<Index>(tables_.column[d]));
  }

  void expand(double unit) { (this->*expand_)(unit); }

 private:
  template <int registers>
  void choose() {
    if constexpr (registers < most) {
      if (tables_.products > registers) return choose<registers + 1>();
    }
    expand_ = &Quadratic::expand_with<registers>;
  }

  template <int registers>
  void expand_with(double unit) {
    V diagonal[CASIMIR_MOST_DIAGONALS], own[registers], factor[registers][width];
    const V x = c[0][0];
    V first = at<V>(tables_.constant) * unit;
    for (int d = 0; d < tables_.diagonals; ++d) {
      diagonal[d] = jacobian(d, x) * unit;
      first += (diagonal[d] + at<V>(tables_.fixed[d]) * unit) * 0.5 *
               permuted(x, at<Index>(tables_.column[d]));
    }
    CASIMIR_UNROLL
    for (int m = 0; m < registers; ++m) {
      own[m] = at<V>(tables_.own[m]) * unit;
      for (int e = 0; e < tables_.moves[m]; ++e)
        factor[m][e] = at<V>(tables_.move[m][e].factor) * unit;
    }
    c[1][0] = first;
    V left[order][registers], right[order][registers], sum[order][registers];
    next<registers, 1>(diagonal, own, factor, left, right, sum);
  }

  template <class T>
  static CASIMIR_INLINE T at(const void* from) {
    T v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }

  CASIMIR_INLINE V jacobian(int d, V x) const {
    V entries = at<V>(tables_.fixed[d]);
    for (int q = 0; q < tables_.parts[d]; ++q) {
      const casimir_move& part = tables_.part[d][q];
      entries += at<V>(part.factor) * permuted(x, at<Index>(part.from));
    }
    return entries;
  }

  /// Coefficient k+1 and all after it.
  template <int registers, int k>
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
        for (int e = 0; e < tables_.moves[m]; ++e)
          inner += factor[m][e] * permuted(total, at<Index>(tables_.move[m][e].from));
      }
    }
    // Two chains: this is what the next coefficient waits for.
    V other = V{};
    for (int d = 0; d < tables_.diagonals; d += 2) {
      inner += diagonal[d] * permuted(x, at<Index>(tables_.column[d]));
      other += diagonal[d + 1] * permuted(x, at<Index>(tables_.column[d + 1]));
    }
    // A rounded 1/(k+1) would err in the same direction at every step, and a million steps add up.
    constexpr double lost = k < Reciprocals::felt ? reciprocal.rest[k + 1] : 0;
    const V rates = inner + other;
    c[k + 1][0] = lost == 0 ? rates * part : rates * part + rates * lost;
    if constexpr (k + 1 < order) {
      push<registers, k>(x, left, right, sum);
      next<registers, k + 1>(diagonal, own, factor, left, right, sum);
    }
  }

  /// The products of coefficient k with those of 1 .. k.
  template <int registers, int k>
  CASIMIR_INLINE void push(V x, V (*left)[registers], V (*right)[registers], V (*sum)[registers]) {
    CASIMIR_UNROLL
    for (int m = 0; m < registers; ++m) {
      const V l = permuted(x, at<Index>(tables_.left[m]));
      const V r = permuted(x, at<Index>(tables_.right[m]));
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

  const casimir_quadratic& tables_;
  void (Quadratic::*expand_)(double unit);
};

}  // namespace casimir_kernel::taylor
