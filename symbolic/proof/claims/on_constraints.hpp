#pragma once

#include <functional>
#include <vector>

#include "symbolic/proof/claims/ranks.hpp"

namespace casimir {

// Facts about almost all points say nothing of a phase space that is a part of them: on the level
// c = 0 of a Casimir function the bracket c of two variables is zero. A rank that a matrix has at
// a point where the constraints vanish it has around it, on the constraints too.

/// A matrix, and the rank that a fact says it has.
struct RankedRows {
  PolynomialRows rows;
  std::size_t rank;
};

/// Leaves the proof of a fact undecided, unless at some exact point of the constraints, the initial
/// state of a scene or another one, each of these matrices has its rank. Nothing is asked of a case
/// without constraints.
void require_on_constraints(Prover& prover, Proof& proof, const std::vector<RankedRows>& all);

/// The same for the independence of functions with these gradients. They have to be independent at
/// the point, and those that are not constant on the constraints, where E = H may be, together with
/// the constraints.
void require_independence_on_constraints(Prover& prover, Proof& proof,
                                         const PolynomialRows& slopes);

/// The structure matrix.
PolynomialRows structure_rows(const Prover& prover);

}  // namespace casimir
