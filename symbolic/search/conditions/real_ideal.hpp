#pragma once

#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir::search {

/// Whether it was shown that polynomials generate the ideal of all polynomials that vanish on
/// their common real zeros, and that the ideal is prime. Without this, what vanishes on a level is
/// not found by cofactors: q^2 + p^2 is zero only where q and p are.
/// \param variables  places in the ring; all others are parameters with generic values
bool is_shown_real_and_prime(std::vector<Polynomial> functions,
                             const std::vector<std::size_t>& variables);

}  // namespace casimir::search
