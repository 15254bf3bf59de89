#pragma once

#include <cstdint>
#include <vector>

#include "runtime/module_abi.h"

namespace casimir {

/// A part of a step of trajectories in lanes: the same polynomials about a later time. The series
/// of a function of the states may need shorter steps than those of the states do.
class PartOfStep {
 public:
  /// Part `which` of `parts` equal ones. The step and its part must live as long as they are used.
  const casimir_lane_step& take(const casimir_lane_step& whole, std::int64_t which,
                                std::int64_t parts);

 private:
  casimir_lane_step step_ = {};
  std::vector<double> times_, lengths_, memory_;
  std::vector<const double*> rows_;
};

}  // namespace casimir
