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
/// - the motion is that of the bracket, without time: a case with a bracket and a Hamiltonian, and
///   no constraints but Casimir functions: on others the functions may depend on each other and the
///   leaves be smaller;
/// - the bracket fulfils the Jacobi identity, which is proved again: else there are no leaves;
/// - all is real: with I in the functions, real and imaginary parts would have to commute too;
/// - the functions are free of the spectral parameter: a function of it is one for each value, and
///   more than one of them may be independent and not commute;
/// - they are smooth, and no more than almost everywhere is said;
/// - all brackets vanish identically, and the rank of their flows is n on each piece.
/// With arbitrary functions nothing is said. On a level of Casimir functions, a union of leaves,
/// the functions need to commute there only, and the motion to keep them there. It is said around
/// one exact point, where the leaf has the dimension of the generic ones and the flows are
/// independent: that they are, holds nearby, and of other parts of the level nothing is known. That
/// they are too few is not said of a level. That they are too few is only said where the leaves
/// have the same dimension almost everywhere and for almost all parameters of every kind that the
/// case allows.
/// \param found  polynomials in the prover's ring
/// \param spectral  the parameter of the pair, if it has one
/// \param on  functions of the level, if there is one
SpectrumCount count_of_spectrum(Prover& prover, const std::vector<Polynomial>& found,
                                const std::optional<GiNaC::symbol>& spectral,
                                const std::vector<NamedExpression>& on = {});

}  // namespace casimir
