#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/structure/separation.hpp"

namespace casimir::tools {

/// Proved where variables were found, where none are needed, or where it is proved that no bivector
/// of this degree gives any; of roots that were given, what is said of them.
Verdict verdict_of(const structure::SeparationReport& report);

/// The document of `search --separation`.
nlohmann::ordered_json to_json(const Model& model, const structure::SeparationReport& report,
                               double seconds);
/// The same for people.
void print(const Model& model, const structure::SeparationReport& report, double seconds);

}  // namespace casimir::tools
