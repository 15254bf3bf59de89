#pragma once

#include <vector>

#include "runtime/step_watch.hpp"

namespace casimir {

/// Looks at the steps of trajectories that stand in the lanes of registers, each by itself: see
/// casimir_ensemble::look.
class LaneLook {
 public:
  /// Borrows the watch.
  LaneLook(const StepWatch& watch, std::size_t states, int lanes);

  /// 1 for a step that may be taken; or how much of it may be tried instead.
  /// \param parameters  those of the member in that lane; null if there are none.
  double operator()(const casimir_lane_step& trial, int lane, const double* parameters);

 private:
  struct Lane {
    StepLook look;
    long long member = -1;
  };

  const std::size_t states_;
  std::vector<Lane> lanes_;
  std::vector<double> begin_, end_;  ///< states
};

}  // namespace casimir
