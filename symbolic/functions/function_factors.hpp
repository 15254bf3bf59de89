#pragma once

#include <utility>
#include <vector>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// Irreducible polynomials with their exponents; the constant factor stands first.
using Factors = std::vector<std::pair<Polynomial, unsigned long>>;

/// The factors of `p`, with (1 - sin)(1 + sin) as cos^2, and with the roots that their relations
/// hide.
Factors factors_of(const GeneratorTable& table, const Polynomial& p);

}  // namespace casimir::functions
