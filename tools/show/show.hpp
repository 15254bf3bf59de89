#pragma once

#include <nlohmann/json.hpp>

#include "tools/show/system_view.hpp"

namespace casimir::tools {

/// Brackets are shown as a matrix up to this many variables.
inline constexpr std::size_t kLargestMatrix = 8;

/// The document of `show --format json`: expressions in the notation of case files, and beside them
/// what a bracket in vectors adds.
nlohmann::ordered_json show_json(const Model& model);

/// The same for people.
void show_text(const Model& model);

/// LaTeX that needs amsmath alone: displays, no preamble.
void show_latex(const Model& model);

}  // namespace casimir::tools
