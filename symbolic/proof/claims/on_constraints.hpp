#pragma once

#include <functional>
#include <vector>

#include "symbolic/proof/claims/constraint_set.hpp"

namespace casimir {

// Facts about almost all points say nothing of a phase space that is a part of them: on the level
// c = 0 of a Casimir function the bracket c of two variables is zero. A rank that a matrix has at
// a point where the constraints vanish it has around it, on the constraints too.

/// Leaves the proof of a fact undecided, unless at some exact point of the constraints, the initial
/// state of a scene or another one, each of these matrices has its rank. Where they may have more
/// than one part (`ConstraintSet`), the fact is one about the part with that point. Nothing is
/// asked of a case without constraints.
void require_on_constraints(Prover& prover, Proof& proof, const std::vector<RankedRows>& all);

/// The same for the independence of functions with these gradients. They have to be independent at
/// the point, and those that are not constant on the constraints, where E - H may be, together with
/// the constraints. (A gradient may be one of the constraints at one point only: on x = 0 that of
/// x + y^2 is at y = 0.)
void require_independence_on_constraints(Prover& prover, Proof& proof,
                                         const std::vector<NamedExpression>& functions);

/// The same for a map f that is shown to have its values, on the constraints, on a set of as many
/// dimensions: leaves its proof undecided, unless f is invertible near some exact point of them.
///
/// Theorem: where the constraints c are a smooth set around a point, with the tangent vectors v
/// that dc v = 0, f is one to one on it near that point if dc v = 0 and df v = 0 have only v = 0 in
/// common (theorem on inverse functions). If it leads into the constraints themselves, it covers a
/// neighbourhood of f(x) there, too, where dc has as large a rank there as at x.
///
/// \param derivatives  df by the variables, of each of some functions, all at one point
/// \param slopes_at  the gradients of the constraints at the values of the last one, by those at x
void require_local_inverse_on_constraints(
    Prover& prover, Proof& proof, const std::vector<PolynomialRows>& derivatives,
    const std::function<PolynomialRows(const PolynomialRows&)>& slopes_at);

/// Decides a claim on the common zero level of functions.
using DecideOnLevel = std::function<void(Proof&, const std::vector<NamedExpression>& on)>;

/// Decides a claim, and once more on what the constraints leave of its level where the first answer
/// is one that `is_open` there.
void decide_within_constraints(Prover& prover, Proof& proof, const std::vector<NamedExpression>& on,
                               const DecideOnLevel& decide,
                               const std::function<bool(const Proof&)>& is_open);

/// Whether the last decision found the claim to hold on the constraints, and not outside of them.
bool is_open_on_constraints(const Prover& prover, const Proof& proof);

/// The structure matrix.
PolynomialRows structure_rows(const Prover& prover);

}  // namespace casimir
