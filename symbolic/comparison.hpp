#pragma once

#include <optional>
#include <string>

namespace casimir {

/// How the two sides of a condition compare, as `!=` in "r != 0".
enum class Comparison { unequal, equal, less, at_most, greater, at_least };

/// The sign of a case file: one of != == < <= > >=.
std::string to_string(Comparison comparison);

/// The comparison that a case file writes so; `=` is `==`. Nothing for any other text.
std::optional<Comparison> comparison_of(const std::string& sign);

/// Whether the sides compare so where their difference has this sign (-1, 0 or 1).
bool holds(Comparison comparison, int sign);

}  // namespace casimir
