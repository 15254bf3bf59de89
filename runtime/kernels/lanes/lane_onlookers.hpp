#pragma once

#include "runtime/kernels/lanes/lane_clock.hpp"
#include "runtime/kernels/lanes/lane_members.hpp"

namespace casimir_kernel::lanes {

/// Shows steps to those outside who asked for it, while the rows still hold them, and takes what
/// they say.
template <class Series>
class Onlookers {
  using V = typename Series::V;
  using M = Mask<V>;

 public:
  Onlookers(const casimir_ensemble& run, Series& series, const Clock<V>& clock,
            const Members<V>& members)
      : run_(run), series_(series), clock_(clock), members_(members) {
    for (int i = 0; i < series_.states; ++i)
      rows_[i] = reinterpret_cast<const double*>(series_.row(i));
  }

  /// Shows an accepted step to who observes the run. Of whom enough has been seen then.
  __attribute__((noinline)) M observe(M held, const Trial<V>& trial) const {
    M finished = {};
    const casimir_lane_step step = shown(held, trial, &finished);
    run_.observe(run_.source, &step);
    return finished & held;
  }

  /// Shows a trial to who looks at steps before they are taken. Leaves those in a mask whose step
  /// may be; of the others, says what part is to be tried next.
  __attribute__((noinline)) void look(M& held, const Trial<V>& trial, Refusals<V>& refusals) const {
    const M asked = held;
    const casimir_lane_step step = shown(asked, trial, nullptr);
    double parts[width_of<V>];
    run_.look(run_.source, &step, parts);
    for (int lane = 0; lane < width_of<V>; ++lane) {
      if (!asked[lane]) continue;
      const double part = parts[lane];
      refusals.jumps[lane] = part > 1 ? -1 : 0;
      if (part >= 1) continue;
      held[lane] = 0;
      refusals.part[lane] = part;
      refusals.cut[lane] = -1;
      refusals.failure[lane] = CASIMIR_STEP_UNDERFLOW;
    }
  }

 private:
  CASIMIR_INLINE casimir_lane_step shown(const M& held, const Trial<V>& trial, M* finished) const {
    return {width_of<V>,
            series_.states,
            series_.order,
            rows_,
            reinterpret_cast<const double*>(&clock_.time()),
            reinterpret_cast<const double*>(&clock_.unit()),
            reinterpret_cast<const double*>(&trial.s),
            members_.numbers(),
            reinterpret_cast<const long long*>(&held),
            reinterpret_cast<long long*>(finished)};
  }

  const casimir_ensemble& run_;
  Series& series_;
  const Clock<V>& clock_;
  const Members<V>& members_;
  const double* rows_[Series::room];
};

}  // namespace casimir_kernel::lanes
