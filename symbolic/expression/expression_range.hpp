#pragma once

#include <cstddef>

#include "symbolic/expression/expression.hpp"

namespace casimir {

/// Reads the expression that stands between two places of a text; errors have their place in all of
/// it.
Quantity parse_range(const Text& text, Scope& names, std::size_t begin, std::size_t end);

}  // namespace casimir
