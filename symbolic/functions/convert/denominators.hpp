#pragma once

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// 1/p by the generators 1/f of the irreducible factors f of p, as a derivative needs it: a
/// function may have values all the same where its derivative has none, as asin(1).
/// \throws ModelError  where p is identically zero
Polynomial inverse_of(GeneratorTable& table, const Polynomial& p);

/// The same of what an expression itself is divided by.
/// \throws NoValue  where p is identically zero
Polynomial divided_by(GeneratorTable& table, const Polynomial& p);

}  // namespace casimir::functions
