#pragma once

#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A vector plus multiples of others, found step by step, that a person would rather write down:
/// with few entries, and these in simple ratios. Vectors have one entry for each monomial.
/// \param fixed  entries from here on decide what the vector is: a step that makes all of them zero
///               is not taken.
std::vector<Residue> shortened(std::vector<Residue> vector,
                               const std::vector<std::vector<Residue>>& others,
                               const Modulus& modulus);

}  // namespace casimir::search
