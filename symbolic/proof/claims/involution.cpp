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
      claims.push_back({ClaimKind::involution,
                        name,
                        true,
                        [f, g, name](Prover& prover, Proof& proof) {
                          const std::vector<Residual> residuals{
                              {name, prover.bracket(f.value, g.value), [&prover, f, g] {
                                 return prover.model().poisson->bracket(f.value, g.value);
                               }}};
                          const Proof blank = proof;
                          prover.decide(proof, residuals, {});
                          if (proof.verdict != Verdict::undecided ||
                              !prover.holds_on_constraints() || !constraints_are_casimirs(prover))
                            return;
                          proof = blank;
                          prover.decide(proof, residuals, prover.level(prover.model().constraints));
                          proof.on = names_of(prover.model().constraints);
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
