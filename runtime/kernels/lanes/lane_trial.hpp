#pragma once

#include "runtime/kernels/lanes/lane_estimates.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"

namespace casimir_kernel::lanes {

/// A trial step in all lanes.
template <class V>
struct Trial {
  V s, h;            ///< its length, in units and in time
  V t1, t1_carry;    ///< where it ends
  Mask<V> there;     ///< it ends with the run
  Mask<V> vanished;  ///< it is too short to move the time
  Mask<V> good;      ///< the states at its end are numbers
};

/// What stood against the trials of the lanes, and what that means for the next ones.
template <class V>
struct Refusals {
  V failure = {};                                       ///< why the last one did not hold
  V part = all_lanes<V>(taylor::StepPolicy::kShorter);  ///< of it, what is tried next
  Mask<V> cut = {};    ///< it was too long only for who looked at it
  Mask<V> jumps = {};  ///< the right-hand side jumps at the end of the trial

  /// A new member in this lane.
  void enter(int lane) {
    failure[lane] = CASIMIR_OK;
    part[lane] = taylor::StepPolicy::kShorter;
    cut[lane] = jumps[lane] = 0;
  }

  CASIMIR_INLINE void because(Mask<V> which, int reason) {
    failure = which ? all_lanes<V>(reason) : failure;
  }
};

}  // namespace casimir_kernel::lanes
