#pragma once

#include "symbolic/search/exponents.hpp"
#include "symbolic/search/exponents/leading_part.hpp"

namespace casimir::search {

/// What the balances and exponents of a report say of integrals and of solutions with one value,
/// with the theorem used: `report.conclusions`.
void conclude(const LeadingPart& leading, ExponentReport& report);

/// Adds to `report.conclusions` that they are about the whole space of the variables, where a case
/// has constraints.
void say_what_of_constraints(const Model& model, ExponentReport& report);

}  // namespace casimir::search
