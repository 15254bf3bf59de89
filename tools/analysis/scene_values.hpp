#pragma once

#include <vector>

#include "symbolic/case_file.hpp"

namespace casimir {

/// Gives a name this value in every scene: a parameter (`table` is &SceneText::parameters) or an
/// initial value (&SceneText::initial). The reference state of a scene that had another value
/// belongs to another motion, and such a scene may be off the levels that it names.
void set_in_scenes(CaseFile& file, std::vector<Entry> SceneText::*table, const Text& name,
                   const Text& value);

/// The case with these initial values in every scene.
/// \param rounded  they are doubles, so a scene may be off its levels by rounding.
/// \throws CaseError  with the nearest variable for a name that is none of the case.
CaseFile with_initial_values(CaseFile file, const std::vector<Entry>& values, bool rounded = false);

}  // namespace casimir
