#pragma once

#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

// What theorems about motions ask for, proved before they are used: in ten seconds at most, else it
// is undecided.

/// Whether the bracket of a case, with the functions of the scene, satisfies the Jacobi identity.
/// Without it a flow keeps H, and neither areas nor the Krein signature of eigenvalues.
/// Undecided where there is no bracket, where it does so but for some states, and where the bracket
/// may jump on the way of a motion.
Verdict verdict_on_jacobi(const Model& model, const Scene& scene);

/// The Casimir functions and integrals of a case that are proved to be such, without conditions.
/// \param model  without arbitrary functions.
std::vector<NamedExpression> proved_invariants(const Model& model);

/// Whether all of these hold for each state, but for those on some surfaces, and for each value of
/// the parameters that the case allows.
/// \param model  without arbitrary functions.
Verdict verdict_on_identities(const Model& model, std::vector<Identity> identities);

}  // namespace casimir
