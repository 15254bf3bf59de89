#pragma once

#include <functional>
#include <vector>

#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/claim.hpp"

namespace casimir {

/// What these claims are before they are decided.
std::vector<Proof> pending_claims(const std::vector<Claim>& claims);

/// What becomes of a claim that has no meaning, as one that divides by what is zero everywhere.
enum class Meaningless {
  thrown,     ///< of what somebody asks for: it is an error
  undecided,  ///< of a file with other claims: these are decided all the same
};

/// Decides them in their order. `report` is called with each as it is done and may return false to
/// stop.
/// \throws ModelError  for a case that has no meaning; for a claim that has none, see `meaningless`
std::vector<Proof> decide_claims(const Model& model, const std::vector<Claim>& claims,
                                 Meaningless meaningless,
                                 const std::function<bool(const Proof&)>& report);

/// The same of claims about the arbitrary functions of a case.
/// \param make  the claims of the case with given functions, in the same order
std::vector<Proof> decide_claims_for_all(
    const Model& model, const std::vector<Claim>& claims, Meaningless meaningless,
    const std::function<bool(const Proof&)>& report,
    const std::function<std::vector<Claim>(const Model&, const GivenFunctions&)>& make);

}  // namespace casimir
