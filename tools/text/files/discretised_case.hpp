#pragma once

#include <optional>
#include <string>

#include "symbolic/discrete/kahan.hpp"
#include "symbolic/model.hpp"

namespace casimir::tools {

/// The case file of a map that was made of a flow.
/// \param method  "Kahan's map"
/// \param value   of the step, as it was typed; without it a scene's step is 1/10
std::string discretised_case(const Model& flow, const RationalMapText& map,
                             const std::string& method, const std::optional<std::string>& value);

}  // namespace casimir::tools
