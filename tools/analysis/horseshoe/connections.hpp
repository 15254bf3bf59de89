#pragma once

#include <functional>
#include <vector>

#include "tools/analysis/horseshoe/hyperbolic_cycles.hpp"

namespace casimir::horseshoe {

/// An orbit, in doubles, that leaves a cycle along its unstable direction and comes near a cycle
/// (the same: it is homoclinic) along the stable direction of that.
struct Connection {
  std::size_t from = 0, to = 0;        ///< which cycles
  std::vector<Eigen::VectorXd> orbit;  ///< begins at a tiny distance from the first point of `from`
  std::vector<double> times;           ///< from each to the next
  /// Directions of length 1 at each: what the flow has made of the unstable one, and what it will
  /// make the stable one of.
  std::vector<Eigen::VectorXd> unstable, stable;
  std::vector<double> growth;  ///< of the first at each return
  std::size_t arrival = 0;     ///< index from which on it is near the cycle `to` ..
  std::size_t phase = 0;       ///< .. and of which point of that it is then
  double angle = 0;            ///< the smallest one, as a sine, between both directions
};

/// Looks for connections between these cycles. The shortest come first.
/// \param size  of the part of the section in which orbits are.
std::vector<Connection> connections(const NumericReturn& map,
                                    const std::vector<HyperbolicCycle>& cycles, std::size_t from,
                                    const std::vector<std::size_t>& to, double size,
                                    const std::function<bool()>& give_up);

}  // namespace casimir::horseshoe
