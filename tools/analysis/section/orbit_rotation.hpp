#pragma once

#include "tools/analysis/frequency/rotation.hpp"
#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// The rotation number of an orbit of a section: see `rotation_of`. Angles among the states count
/// by cosine and sine, and the direction is that of the plotted pair.
Rotation rotation_of_orbit(const SectionProblem& problem, const OrbitReport& orbit);

/// The same of a map, whose states are no angles.
Rotation rotation_of_map_orbit(const OrbitReport& orbit);

}  // namespace casimir
