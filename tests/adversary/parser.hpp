#pragma once

#include <string>

#include "tests/adversary/case.hpp"

namespace casimir::adversary {

/// Reads an expression of case files: for what the library prints, as witnesses and integrals that
/// a search found. \throws std::runtime_error for anything else
Expr parse(const std::string& text);
/// Reads "LEFT RELATION RIGHT".
Assumption parse_assumption(const std::string& text);

}  // namespace casimir::adversary
