#pragma once

#include <vector>

#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// So many orbits spread over the domain of possible motion, cut and judged: a section without any
/// wishes. None where nothing that moves on the level returns to the plane.
std::vector<OrbitReport> domain_orbits(const LevelSet& level, const OrbitCutter& cutter,
                                       std::size_t orbits, std::size_t points);

}  // namespace casimir
