#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "symbolic/error.hpp"

namespace casimir::tools {

/// A document of `--json` with the version of its keys in front, and the end of a line behind.
std::string json_text(const nlohmann::ordered_json& document);

/// The same to standard output, where nothing else is written beside it.
void print_json(const nlohmann::ordered_json& document);

/// `{"error": {"text", "file", "line", "column", "hint"}}`: without a place and a hint where there
/// is none.
nlohmann::ordered_json error_json(const std::string& text);
nlohmann::ordered_json error_json(const CaseError& problem);

}  // namespace casimir::tools
