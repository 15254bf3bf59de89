#pragma once

#include "runtime/kernels/taylor/series.h"
#include "runtime/kernels/taylor/taylor.hpp"

namespace casimir_kernel::taylor {

/// How many registers hold a state: a constant, or for 0 a number at run time.
template <int fixed>
struct Blocks {
  static constexpr int blocks = fixed, room = fixed;
  explicit Blocks(int) {}
};
template <>
struct Blocks<0> {
  const int blocks;
  static constexpr int room = CASIMIR_SERIES_STATES / kNativeWidth;
  explicit Blocks(int count) : blocks(count) {}
};

/// A series whose coefficients somebody else works out, in rows that he has room for.
template <int fixed>
struct CalledSeries : Blocks<fixed> {
  static constexpr int width = kNativeWidth;
  using V = Lanes<width>;
  static constexpr bool prepared = true;

  struct Rows {
    V* at;
    int stride;
    CASIMIR_INLINE V* operator[](int k) const { return at + k * (fixed > 0 ? fixed : stride); }
  };

  const int states, order;
  const bool smooth;
  V* const rate;
  const Rows c;

  CalledSeries(const casimir_series& series, int the_order, int count)
      : Blocks<fixed>(count),
        states(series.states),
        order(the_order),
        smooth(series.smooth),
        rate(reinterpret_cast<V*>(series.rows)),
        c{rate + count, count},
        series_(series) {}

  CASIMIR_INLINE void begin(double t, const V* x) {
    series_.begin(series_.object, t, reinterpret_cast<const double*>(x));
  }
  CASIMIR_INLINE void expand(double unit) { series_.expand(series_.object, unit); }

 private:
  const casimir_series& series_;
};

}  // namespace casimir_kernel::taylor
