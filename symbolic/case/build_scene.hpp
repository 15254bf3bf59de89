#pragma once

#include "symbolic/model.hpp"

namespace casimir {

/// Reads a scene of a case whose names, assumptions and earlier scenes are in `model`.
/// \param fixed  parameters that have a value from outside.
/// \throws CaseError  for a name that is not of this case, a missing value, or one outside the
///                    assumptions.
Scene read_scene(const SceneText& text, const Model& model, const ParameterValues& fixed);

}  // namespace casimir
