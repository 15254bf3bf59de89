#pragma once

#include <string>
#include <vector>

#include "symbolic/functions/function_ring.hpp"

namespace casimir::search {

/// A polynomial as a person would write it: the shortest of a product of powers, a sum with the
/// coefficients of each monomial in front of it, and one or two squares and what remains. It is
/// the polynomial itself, but for its sign.
/// \param constant  which of the ring's variables are parameters, or made of them
std::string short_text(const FunctionRing& ring, const Polynomial& p,
                       const std::vector<bool>& constant);

}  // namespace casimir::search
