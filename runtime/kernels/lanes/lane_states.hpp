#pragma once

#include "runtime/kernels/carried_sum.hpp"
#include "runtime/kernels/lanes/lane_estimates.hpp"

namespace casimir_kernel::lanes {

/// For each state; written out where their number is known.
template <class Series, class Action>
CASIMIR_INLINE void each_state(const Series& series, Action action) {
  if constexpr (Series::fixed_states) {
    CASIMIR_UNROLL
    for (int i = 0; i < Series::states; ++i) action(i);
  } else {
    for (int i = 0; i < series.states; ++i) action(i);
  }
}

/// The states in the lanes, summed with carries, and what a trial makes of them. The sums
/// themselves are the first coefficients of the series, which each function is given: an address
/// that stands in one place only stays in a register from the size of a step to its end.
template <class Series>
class States {
  using V = typename Series::V;
  using M = Mask<V>;
  static constexpr int room = Series::room;

 public:
  explicit States(Series& series) {
    for (int i = 0; i < series.states; ++i) series.row(i)[0] = carry_[i] = V{};
  }

  void enter(Series& series, int lane, const double* x) {
    for (int i = 0; i < series.states; ++i) {
      series.row(i)[0][lane] = x[i];
      carry_[i][lane] = 0;
    }
  }

  /// Those of a lane, which then holds zeros.
  void leave(Series& series, int lane, double* x) {
    for (int i = 0; i < series.states; ++i) {
      x[i] = series.row(i)[0][lane];
      series.row(i)[0][lane] = 0;
    }
  }

  /// The states, beside each other.
  const V* now(Series& series) {
    for (int i = 0; i < series.states; ++i) now_[i] = series.row(i)[0];
    return now_;
  }
  /// Those at the end of the last trial.
  CASIMIR_INLINE const V* next() const { return next_; }

  /// Sums the series after s units, in four chains. Where what comes out is finite. The product
  /// with s and the sum with the carry stand in one place: whether they are fused must not depend
  /// on how the loop is compiled.
  CASIMIR_INLINE M sum(Series& series, V s) {
    const V s2 = s * s, s4 = s2 * s2;
    V zero = V{};
    each_state(series, [&](int i) CASIMIR_INLINE_LAMBDA {
      const V* c = series.row(i) + series.order - 3;
      V p0 = c[0], p1 = c[1], p2 = c[2], p3 = c[3];
      for (int k = series.order - 4; k > 0; k -= 4) {
        c -= 4;
        p0 = p0 * s4 + c[0];
        p1 = p1 * s4 + c[1];
        p2 = p2 * s4 + c[2];
        p3 = p3 * s4 + c[3];
      }
      V x = c[-1], carry = carry_[i];
      add_carried(x, carry, ((p0 + p1 * s) + (p2 + p3 * s) * s2) * s);
      next_[i] = x;
      next_carry_[i] = carry;
      zero += x * 0;
    });
    return zero == 0;
  }

  CASIMIR_INLINE void accept(Series& series, M held) {
    each_state(series, [&](int i) CASIMIR_INLINE_LAMBDA {
      V& x = series.row(i)[0];
      x = held ? next_[i] : x;
      carry_[i] = held ? next_carry_[i] : carry_[i];
    });
  }

 private:
  V carry_[room], next_[room], next_carry_[room], now_[room];
};

}  // namespace casimir_kernel::lanes
