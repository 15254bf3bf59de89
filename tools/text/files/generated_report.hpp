#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/specialise.hpp"

namespace casimir::tools {

/// {"mul", "add", "div", "calls"}.
nlohmann::ordered_json to_json(const OperationCount& count);

/// [{"kind", "name", "reason"}, ..].
nlohmann::ordered_json left_out_json(const Specialisation& specialisation);

/// {"rhs": {"mul", ..}, "jacobian": {.., "entries"}, ..}: the operations of each function that was
/// generated, and for a matrix how many of its entries are not always zero.
nlohmann::ordered_json functions_json(const Specialisation& specialisation);

/// Lines that say what was generated and what was left out, with the operation counts of one
/// right-hand side before and after and those of the other functions.
std::string generated_text(const Specialisation& specialisation);

}  // namespace casimir::tools
