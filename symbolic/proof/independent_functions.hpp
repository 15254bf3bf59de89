#pragma once

#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Whether functions without parameters are certainly independent over the constants on every piece
/// of the domain that is found, so that a sum of constants times them is identically zero on none
/// of these unless all constants are zero: |z| and z are not, where z > 0.
///
/// Exponentials of polynomials that are independent over the rational numbers up to constants are
/// algebraically independent over the rational functions (Ax 1971), so that there polynomials in
/// them are independent as functions where they are as polynomials. Else, theorem: a combination
/// that is zero on a piece is zero at its points, so that a matrix of values at points of one
/// piece, a column for each function, has a smaller rank then. Checked: its full rank, by balls,
/// for each piece. False, too, where the pieces are not known
/// (`FunctionRing::Pieces`) or the functions are many.
bool independent_on_pieces(Prover& prover, const std::vector<Polynomial>& functions);

}  // namespace casimir
