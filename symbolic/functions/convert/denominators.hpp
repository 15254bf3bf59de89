#pragma once

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// 1/p by the generators 1/f of the irreducible factors f of p.
/// \throws ModelError  where p is identically zero
Polynomial inverse_of(GeneratorTable& table, const Polynomial& p);

}  // namespace casimir::functions
