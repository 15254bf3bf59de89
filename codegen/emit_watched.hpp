#pragma once

#include <string>

#include "codegen/specialise.hpp"

namespace casimir {

/// What a module exports beside what `emit_module` and `emit_series_lanes` write, where its steps
/// are watched: `casimir_watched` and `casimir_watched_count`, see runtime/module_abi.h. To be
/// written behind the text of the module.
/// \param watched  a program of the same inputs as the right-hand side; without outputs there is
///                 nothing to be exported, and the text is empty.
std::string emit_watched(const Specialisation& specialisation, const Program& watched);

}  // namespace casimir
