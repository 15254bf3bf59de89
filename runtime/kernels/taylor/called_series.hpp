#pragma once

#include "runtime/kernels/taylor/blocks.hpp"
#include "runtime/kernels/taylor/series.h"
#include "runtime/kernels/taylor/taylor.hpp"

namespace casimir_kernel::taylor {

/// A series whose coefficients somebody else works out, in rows that he has room for.
template <int fixed>
struct CalledSeries : Blocks<fixed, CASIMIR_SERIES_STATES / kNativeWidth> {
  static constexpr int width = kNativeWidth;
  using V = Lanes<width>;

  const int states, order;
  const bool smooth, prepared;
  V* const rate;
  const Rows<V, fixed> c;

  CalledSeries(const casimir_series& series, int the_order, int count)
      : Blocks<fixed, CASIMIR_SERIES_STATES / kNativeWidth>(count),
        states(series.states),
        order(the_order),
        smooth(series.smooth),
        prepared(!series.direct),
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
