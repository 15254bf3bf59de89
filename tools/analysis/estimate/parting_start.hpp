#pragma once

#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Whether more than one solution may leave the start of a run: as x = 0 and x = t^2/4 do of x' =
/// sqrt(x) at x = 0, an edge of where the equations have values. From starts that are nearer and
/// nearer the solutions end as far away. By runs in double precision: no proof.
/// \param begin  the time of the start
/// \param duration  of the run, with its sign
bool may_part_at_start(const PreparedScene& run, double begin, double duration);

}  // namespace casimir
