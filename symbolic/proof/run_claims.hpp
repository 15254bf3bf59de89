#pragma once

#include <functional>
#include <vector>

#include "symbolic/proof/claims/claim.hpp"

namespace casimir {

/// What these claims are before they are decided.
std::vector<Proof> pending_claims(const std::vector<Claim>& claims);

/// Decides them in their order. `report` is called with each as it is done and may return false to
/// stop.
std::vector<Proof> decide_claims(const Model& model, const std::vector<Claim>& claims,
                                 const std::function<bool(const Proof&)>& report);

}  // namespace casimir
