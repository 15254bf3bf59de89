// Involution of the integrals, pair by pair: a fact about the system, not a claim, since the
// integrals of a superintegrable system do not all commute.
#include <fmt/format.h>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"

namespace casimir {

namespace {

Claim involution_claim(const NamedExpression& f, const NamedExpression& g) {
  const std::string name = fmt::format("{{{}, {}}}", f.name, g.name);
  Claim claim{ClaimKind::involution, name, true, [f, g, name](Prover& prover, Proof& proof) {
                const std::vector<Residual> residuals{
                    {name, prover.bracket(f.value, g.value), [&prover, f, g] {
                       return prover.model().poisson->bracket(f.value, g.value);
                     }}};
                const auto on_level = [&](Proof& own, const auto& level) {
                  prover.decide(own, residuals, prover.level(level));
                };
                decide_within_constraints(prover, proof, {}, on_level, [&](const Proof& open) {
                  return is_open_on_constraints(prover, open) && constraints_are_casimirs(prover);
                });
                if (proof.on.empty()) prover.say_where_differentiable(proof, {f.value, g.value});
              }};
  claim.expressions = values_of({f, g});
  claim.subject = Subject::bracket;
  return claim;
}

}  // namespace

std::vector<Claim> involution_claims(const Model& model) {
  std::vector<Claim> claims;
  if (!model.poisson) return claims;
  for (std::size_t i = 0; i < model.integrals.size(); ++i)
    for (std::size_t j = i + 1; j < model.integrals.size(); ++j)
      claims.push_back(involution_claim(model.integrals[i], model.integrals[j]));
  return claims;
}

}  // namespace casimir
