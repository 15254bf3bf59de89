#pragma once

#include <functional>
#include <vector>

#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// So many orbits spread over the domain of possible motion, cut and judged: a section without any
/// wishes. None where nothing that moves on the level returns to the plane.
/// \param progress  told now and then what share of the crossings is there
std::vector<OrbitReport> domain_orbits(const LevelSet& level, const OrbitCutter& cutter,
                                       std::size_t orbits, std::size_t points,
                                       const std::function<void(double)>& progress = {});

}  // namespace casimir
