#pragma once

#include "runtime/kernels/lanes/lane_states.hpp"
#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"

// What the tolerance makes of steps: their order, and their length in each lane.

namespace casimir_kernel::lanes {

/// The order that a run asks for, or the one at which its tolerance costs least.
inline int order_of(const casimir_ensemble* run) {
  const int order = run->order > 0 ? run->order : taylor::order_of_many(run->rtol);
  return order < 24 ? order : 24;
}

/// The error allowed to a state, whose size is what it takes during a step of so many units.
/// \param c  the coefficients of the state.
template <class V>
CASIMIR_INLINE V allowed(const casimir_ensemble& run, const V* c, V s = all_lanes<V>(1)) {
  const V size = absolute(c[0]) + (absolute(c[1]) + absolute(c[2]) * s) * s;
  return larger_of(run.atol + run.rtol * size, all_lanes<V>(0x1p-1000));
}

/// The steps in units at which the last two terms are as large as the tolerance allows, or 0 where
/// the coefficients are no numbers.
template <class Series>
CASIMIR_INLINE typename Series::V chosen_steps(const casimir_ensemble& run, Series& series) {
  using V = typename Series::V;
  using Policy = taylor::StepPolicy;
  const int order = series.order;
  V a = V{}, z = V{};
  each_state(series, [&](int i) CASIMIR_INLINE_LAMBDA {
    const V* c = series.row(i);
    const V weight = rough_inverse(allowed(run, c));
    a += absolute(c[order - 1]) * weight;
    z += absolute(c[order]) * weight;
  });
  const V rate =
      larger_of(lanes::rough_log2(a) * (1. / (order - 1)), lanes::rough_log2(z) * (1. / order));
  const V s = rate < Policy::kSteepest ? all_lanes<V>(Policy::kLongest) : lanes::rough_exp2(-rate);
  return a + z < Policy::kNoNumber ? s : V{};
}

/// The time in which the solution changes by its own size, or the whole where that is less: a
/// guess, which the coefficients correct.
template <class V>
V own_time_scale(const casimir_ensemble& run, double span, int states, const V* x, const V* rate) {
  V size = all_lanes<V>(run.atol), speed = V{};
  for (int i = 0; i < states; ++i) {
    size = larger_of(size, absolute(x[i]));
    speed = larger_of(speed, absolute(rate[i]));
  }
  const V whole = all_lanes<V>(magnitude(span));
  const V scale = size / (speed > 0 ? speed : all_lanes<V>(1));
  return ((speed > 0) & (scale < whole)) ? scale : whole;
}

}  // namespace casimir_kernel::lanes
