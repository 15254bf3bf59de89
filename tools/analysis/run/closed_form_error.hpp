#pragma once

#include <optional>

#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Of the closed form of a scene: about the most that rounding leaves, in parts of the largest
/// values on the way (`ClosedForm::error`). Nothing where there is no closed form.
std::optional<double> closed_form_error(const PreparedScene& run);

}  // namespace casimir
