#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/structure/separation.hpp"

namespace casimir::tools {

/// Whether the question is answered: variables were found, none are needed, or it is proved that no
/// bivector of this degree gives any.
bool is_answered(const structure::SeparationReport& report);

/// The document of `search --separation`.
nlohmann::ordered_json to_json(const Model& model, const structure::SeparationReport& report,
                               double seconds);
/// The same for people.
void print(const Model& model, const structure::SeparationReport& report, double seconds);

}  // namespace casimir::tools
