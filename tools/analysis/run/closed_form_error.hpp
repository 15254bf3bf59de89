#pragma once

#include <optional>
#include <vector>

#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Of the closed form of a scene: about the most that rounding leaves, in parts of `sizes`
/// (`ClosedForm::error`). Nothing where there is no closed form.
/// \param sizes  of the states, in a run
std::optional<double> closed_form_error(const PreparedScene& run, const std::vector<double>& sizes);

/// The period of the closed form of a scene. Nothing where there is no closed form.
std::optional<double> closed_form_period(const PreparedScene& run);

}  // namespace casimir
