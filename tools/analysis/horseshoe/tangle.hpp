#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/analysis/horseshoe/connections.hpp"

namespace casimir::horseshoe {

/// A parallelogram that is to become an h-set, in doubles.
struct PlannedSet {
  std::string name;
  Eigen::VectorXd centre;
  Eigen::VectorXd along, across;  ///< of length 1
  double half_along = 0, half_across = 0;
  Eigen::MatrixXd parts;  ///< 2 x n: from x - centre to its parts along both directions
};

/// Which sets ought to cover which.
struct PlannedTangle {
  std::vector<PlannedSet> sets;
  std::vector<std::pair<std::size_t, std::size_t>> arrows;  ///< from, to
};

/// A connection, and which of its points become h-sets: those from `departure` to `arrival` - 1.
struct Excursion {
  const Connection* connection = nullptr;
  std::size_t departure = 0, arrival = 0;
};

/// All choices of the points of a connection, those with few h-sets first.
/// \param size  of the section.
std::vector<Excursion> excursions(const std::vector<HyperbolicCycle>& cycles,
                                  const Connection& connection, double size);

/// H-sets at the points of cycles and along excursions from each of these to the next (of one cycle
/// to itself), of such sizes that each covers those after it as far as some orbits show. Nothing
/// where there are none.
std::optional<PlannedTangle> planned_tangle(const NumericReturn& map,
                                            const std::vector<HyperbolicCycle>& cycles,
                                            const std::vector<Excursion>& excursions, double size);

}  // namespace casimir::horseshoe
