#pragma once

#include <cstddef>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// Whether the common zeros certainly have more than so many dimensions less than the space. The
/// zeros of an ideal have no more dimensions than those of some of its elements' leading monomials,
/// on which one variable at least of each is zero.
bool has_codimension_above(std::size_t bound, const std::vector<Polynomial>& polynomials);

/// Whether the common zeros of polynomials, in complex space, are irreducible over the rationals.
/// False where that is not found out: it is where there is one irreducible polynomial, where one is
/// linear in a variable that the others do not have, and for products of such sets.
/// \param geometrically  whether there is a regular zero with rational coordinates: then they are
///                       irreducible over all numbers where they are over these, and so are
///                       products
bool has_irreducible_zeros(const std::vector<Polynomial>& polynomials, bool geometrically);

}  // namespace casimir
