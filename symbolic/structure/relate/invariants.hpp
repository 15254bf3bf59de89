#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/structure/relate/linear_case.hpp"

namespace casimir::structure {

/// Numbers of a bracket, by what they are: where one differs for two brackets, no regular linear
/// map with real (nor, but for the signature, complex) coefficients takes one to the other.
///
/// Theorem: a linear map y = T x with {y_i, y_j} = Q_ij(y) respects each homogeneous part of the
/// bracket for itself; so do the dimensions of the spaces that the components of a part span. The
/// part of degree 1 is a skew product on the linear functions, and y_i -> sum_a T_ia x_a is an
/// isomorphism of these products; every dimension that is defined by the product alone agrees, and
/// so do rank and signature of the form tr(ad x ad y) (Sylvester) and the numbers c in identities
/// c tr(ad(x)^k)^a = tr(ad(x)^m)^b. That the product obeys the Jacobi identity is not used.
/// All of them are computed exactly.
std::vector<std::pair<std::string, std::string>> linear_invariants(const LinearCase& c);

/// Positive and negative squares of a symmetric matrix, by Lagrange's reduction.
std::pair<std::size_t, std::size_t> signature(RationalMatrix symmetric);

/// The terms of the derived series, the lower and upper central series and the null space of the
/// Killing form: subspaces that every isomorphism keeps, in this order, each by its basis.
std::vector<std::pair<std::string, RationalMatrix>> characteristic_subspaces(
    const StructureConstants& c);

}  // namespace casimir::structure
