#pragma once

#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Of a case with I anything beside polynomials may be complex: a root too, of a negative number.
bool may_be_complex(const Prover& prover, const Polynomial& f);

/// Whether the bracket has a number that is not real, or the Hamiltonian, if there is one, may be
/// complex: then there is no real motion, and `real_ones` would leave the Hamiltonian out, which
/// all others have to commute with.
bool has_complex_motion(Prover& prover);

/// Those of the functions that are real. The theorems of Liouville and Mishchenko and Fomenko count
/// real functions: the levels of q + I*p are those of q and p, which do not commute.
std::vector<NamedExpression> real_ones(Prover& prover, std::vector<NamedExpression> functions);

}  // namespace casimir
