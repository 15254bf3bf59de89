#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "symbolic/lie_algebra.hpp"

namespace casimir {

/// A homogeneous polynomial in the coordinates of a Lie algebra's dual: each term is the indices of
/// its factors, in ascending order, and an integer coefficient.
using IntegerForm = std::vector<std::pair<std::vector<std::size_t>, long>>;

/// A basis of the forms F of that degree with {x_i, F} = 0 for every coordinate: the equations for
/// their coefficients are linear, and solved exactly. Coefficients have no common factor and the
/// first one is positive. Sums of squares come before others.
/// \throws ModelError  for a coefficient that does not fit a word.
std::vector<IntegerForm> invariant_forms(const LieAlgebra& algebra, std::size_t degree);

/// Those of degree 1, and those of degree 2 that are not sums of products of these.
std::vector<IntegerForm> invariant_forms_to_degree_two(const LieAlgebra& algebra);

}  // namespace casimir
