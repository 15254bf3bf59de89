#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/discrete/map_model.hpp"
#include "tools/show/system_view.hpp"

namespace casimir::tools {

/// Brackets are shown as a matrix up to this many variables.
inline constexpr std::size_t kLargestMatrix = 8;

/// The document of `show --format json`: expressions in the notation of case files, and beside them
/// what a bracket in vectors adds.
nlohmann::ordered_json show_json(const Model& model);

/// The same for people.
void show_text(const Model& model);

/// Displays alone, to stand in a paper that has amsmath, or a document that compiles as it is.
enum class LatexUse { displays, document };
void show_latex(const Model& model, LatexUse use = LatexUse::displays);

/// The same three for the case of a map: the next values in place of Hamiltonian and equations.
/// {
nlohmann::ordered_json show_json(const MapModel& map);
void show_text(const MapModel& map);
void show_latex(const MapModel& map, LatexUse use = LatexUse::displays);
/// }

}  // namespace casimir::tools
