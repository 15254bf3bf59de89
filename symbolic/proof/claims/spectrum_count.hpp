#pragma once

#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Liouville's count of the integrals that a proved Lax pair gives, on generic leaves.
///
/// Theorem (Liouville): on a symplectic leaf of dimension 2n a motion with n integrals that are in
/// involution and have independent differentials there is integrable by quadratures. The
/// Hamiltonian need not be among them: it commutes with all, as they are integrals, so that its
/// differential is a combination of theirs where these span a Lagrangian subspace. Hypotheses:
/// - the motion is that of the bracket, without time: a case with a bracket and a Hamiltonian;
/// - the functions are real: with I in them, real and imaginary parts would have to commute too;
/// - they are smooth, and no more than almost everywhere is said;
/// - all brackets vanish identically, and the rank of their flows is n on each piece.
/// On a level, or with arbitrary functions, nothing is said.
/// \param found  polynomials in the prover's ring
SpectrumCount count_of_spectrum(Prover& prover, const std::vector<Polynomial>& found);

}  // namespace casimir
