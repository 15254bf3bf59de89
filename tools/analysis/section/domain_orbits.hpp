#pragma once

#include <functional>
#include <vector>

#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// Points all over the domain of possible motion that orbits return from: a section without any
/// wishes. None where nothing that moves on the level returns to the plane.
std::vector<PlacedPoint> domain_of_motion(const LevelSet& level, const OrbitCutter& cutter);

/// So many orbits spread over this domain, cut and judged.
/// \param progress  told now and then what share of the crossings is there
std::vector<OrbitReport> domain_orbits(const LevelSet& level, const OrbitCutter& cutter,
                                       const std::vector<PlacedPoint>& domain, std::size_t orbits,
                                       std::size_t points,
                                       const std::function<void(double)>& progress = {});

}  // namespace casimir
