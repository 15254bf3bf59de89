#pragma once

#include <functional>
#include <vector>

#include "runtime/step/step_look.hpp"

namespace casimir {

/// Looks at the steps of trajectories that stand in the lanes of registers, each by itself: see
/// casimir_ensemble::look.
class LaneLook {
 public:
  /// The parameters of a member; null if there are none.
  using Parameters = std::function<const double*(long long member)>;

  /// Borrows the watch.
  LaneLook(const StepWatch& watch, std::size_t states, int lanes, Parameters parameters);

  /// Runs end before poles: see StepLook.
  void end_before_poles();
  /// Whether a member that stands in a lane could not go on for that reason.
  bool at_pole(long long member) const;

  /// \param parts  for each lane that is to take the step, what StepLook says.
  void operator()(const casimir_lane_step& trial, double* parts);

  /// What StepLook says of the step of one lane, or of a part of it. The others are left alone.
  double of_lane(const casimir_lane_step& trial, int lane);

 private:
  struct Lane {
    StepLook look;
    long long member = -1;
    bool quiet = false;
  };

  template <class Look>
  auto look(const casimir_lane_step& trial, std::size_t lane, const Look& looks);

  const std::size_t states_;
  const Parameters parameters_;
  std::vector<Lane> lanes_;
  std::vector<double> places_;        ///< in units of time, one for each lane
  std::vector<double> middle_, end_;  ///< states, each in all lanes
  std::vector<double> x0_, xm_, x1_;  ///< of one lane
};

}  // namespace casimir
