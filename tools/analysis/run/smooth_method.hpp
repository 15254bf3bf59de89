#pragma once

#include "runtime/methods.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What `auto` begins with: the method of Taylor series or, for a dozen states and more that have
/// to be compiled anyhow, dop853, if by a model of their costs it takes well less time: where few
/// digits are asked for. Tables need no compiler, which no shorter run makes up for, and stay.
/// Equations with branches stay with Taylor series, too, which know them best.
/// \param tolerance  relative; 0 for a constant step.
const Method& smooth_method(const PreparedScene& run, double tolerance);

}  // namespace casimir
