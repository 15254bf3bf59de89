// Involution of the integrals, pair by pair: a fact about the system, not a claim, since the
// integrals of a superintegrable system do not all commute.
#include <fmt/format.h>

#include "symbolic/proof/claims/claim.hpp"

namespace casimir {

std::vector<Claim> involution_claims(const Model& model) {
  std::vector<Claim> claims;
  if (!model.poisson) return claims;
  for (std::size_t i = 0; i < model.integrals.size(); ++i) {
    for (std::size_t j = i + 1; j < model.integrals.size(); ++j) {
      const NamedExpression f = model.integrals[i];
      const NamedExpression g = model.integrals[j];
      const std::string name = fmt::format("{{{}, {}}}", f.name, g.name);
      claims.push_back(
          {ClaimKind::involution,
           name,
           true,
           [f, g, name](Prover& prover, Proof& proof) {
             prover.decide(
                 proof,
                 {{name, prover.bracket(f.value, g.value),
                   [&prover, f, g] { return prover.model().poisson->bracket(f.value, g.value); }}},
                 {});
           },
           {},
           values_of({f, g}),
           false,
           Subject::bracket});
    }
  }
  return claims;
}

}  // namespace casimir
