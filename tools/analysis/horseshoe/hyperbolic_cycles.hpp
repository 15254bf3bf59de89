#pragma once

#include <functional>
#include <vector>

#include "tools/analysis/horseshoe/numeric_return.hpp"

namespace casimir::horseshoe {

/// A hyperbolic cycle of the return map with its directions, in doubles.
struct HyperbolicCycle {
  std::vector<Eigen::VectorXd> points;  ///< in the order in which they are visited
  std::vector<double> times;            ///< from each to the next
  double unstable = 0, stable = 0;      ///< multipliers of the whole cycle
  /// Directions of length 1 along the surface and the level at each point; those of a point are
  /// mapped to multiples of those of the next.
  std::vector<Eigen::VectorXd> unstable_directions, stable_directions;
  /// For each point: from a small difference of a state to its parts along both directions there.
  std::vector<Eigen::MatrixXd> parts;

  std::size_t length() const { return points.size(); }
  /// The growth along the unstable direction at each return, on the average.
  double growth() const;
};

/// Looks for cycles up to a length by Newton's method, from an orbit and from random points of the
/// level. Those that grow most come first. Finds what it finds.
/// \param give_up  asked now and then.
std::vector<HyperbolicCycle> hyperbolic_cycles(const SectionSystem& system,
                                               const NumericReturn& map, std::size_t longest,
                                               const std::function<bool()>& give_up);

}  // namespace casimir::horseshoe
