// Equality of two functions, on a level if one is given: what a user writes down to check.
#include <fmt/format.h>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"

namespace casimir {

Claim identity_claim(const Identity& identity) {
  Claim claim{ClaimKind::identity, identity.name, false, [identity](Prover& prover, Proof& proof) {
                const GiNaC::ex defect = identity.left - identity.right;
                const std::vector<Residual> residuals{
                    {"left - right", prover.convert(defect), [defect] { return defect; }}};
                const auto on_level = [&](Proof& own, const auto& level) {
                  prover.decide(own, residuals, prover.level(level));
                };
                decide_within_constraints(
                    prover, proof, identity.on, on_level,
                    [&](const Proof& open) { return is_open_on_constraints(prover, open); });
              }};
  claim.expressions = {identity.left - identity.right};
  // The sides themselves: their difference may be 0 where they have no values.
  for (const GiNaC::ex& side : {identity.left, identity.right}) claim.expressions.push_back(side);
  for (const GiNaC::ex& part : identity.domain) claim.expressions.push_back(part);
  for (const GiNaC::ex& value : values_of(identity.on)) claim.expressions.push_back(value);
  claim.on = names_of(identity.on);
  claim.subject = Subject::functions;
  return claim;
}

std::vector<Claim> identity_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const Identity& identity : model.identities) claims.push_back(identity_claim(identity));
  return claims;
}

}  // namespace casimir
