#pragma once

#include <array>
#include <map>
#include <vector>

#include "symbolic/obstruction/higher/jet.hpp"

namespace casimir::obstruction {

/// The product y1 y2 = q11 u1^2 + q12 u1 u2 + q22 u2^2 of two solutions, by a basis u1, u2.
using ProductOfSolutions = std::array<cln::cl_RA, 3>;

/// A form in two constants: coefficients of c1^j c2^(r - j) for j = 0, .., r.
using BinaryForm = std::vector<cln::cl_RA>;

/// A polynomial in constants, as coefficients.
using ConstantPolynomial = std::map<Monomial, cln::cl_RA>;

/// The coefficient of (c1 c2)^m, in the constants for y1 and y2, in a form of degree 2 m; up to a
/// factor (d/dy1 d/dy2)^m of it. Where y1 and y2 are one line, the form itself decides.
/// \return  whether it is not zero; false for odd degrees
bool has_invariant_part(const BinaryForm& form, const ProductOfSolutions& product);

/// Whether a form in two constants is no multiple of the power of c1 c2, in the constants for y1
/// and y2; false where these are one line.
bool has_other_part(const BinaryForm& form, const ProductOfSolutions& product);

/// The forms in the last two constants that a polynomial vector field in constants c1, .., cn has
/// where the first ones do not change: of those components that belong to c1, .., c(n-2) the
/// coefficients, and of the others their determinant with the last two constants.
std::vector<BinaryForm> forms_of(const std::vector<ConstantPolynomial>& field);

}  // namespace casimir::obstruction
