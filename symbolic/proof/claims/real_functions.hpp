#pragma once

#include <string>
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

/// Takes out the functions that may jump on the way of a motion (`Prover::passed_jumps`). The
/// theorems need functions that are constant on motions as long as these last: with frequencies 1
/// and sqrt(2) motions are dense on tori, and sqrt(2)*atan2(x, px) - atan2(y, py) has the rate zero
/// wherever it has one. Those stay that have a pole there, as 1/|x|, which motions may not pass:
/// for motions that do not, as `where_beside_poles` says.
/// \return  which they are, as the end of a reason; empty where there are none
std::string take_out_jumping(Prover& prover, std::vector<NamedExpression>& functions);

/// Conditions on the motions for which those that stay are continuous.
std::vector<std::string> where_beside_poles(Prover& prover,
                                            const std::vector<NamedExpression>& functions);

}  // namespace casimir
