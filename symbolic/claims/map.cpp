// Poisson and anti-Poisson maps y = phi(x): {phi_i, phi_j} = sign * {y_i, y_j} at y = phi(x).
#include <fmt/format.h>

#include "symbolic/claims/claim.hpp"

namespace casimir {
namespace {

void decide_map(Prover& prover, Proof& proof, const PoissonMap& map) {
  const std::vector<GiNaC::ex> target = map.composed_brackets();
  const auto& y = map.target.coordinates();
  std::vector<Residual> residuals;
  std::size_t index = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = i + 1; j < y.size(); ++j, ++index) {
      const GiNaC::ex expected = map.sign * target[index];
      residuals.push_back(
          {fmt::format("{{{0}, {1}}} less its image", y[i].get_name(), y[j].get_name()),
           prover.bracket(prover.convert(map.expressions[i]), prover.convert(map.expressions[j])) -
               prover.convert(expected),
           [&prover, &map, i, j, expected] {
             return prover.model().poisson->bracket(map.expressions[i], map.expressions[j]) -
                    expected;
           }});
    }
  }
  prover.decide(proof, residuals, prover.level(map.on));
}

std::vector<GiNaC::ex> expressions_of(const PoissonMap& map) {
  std::vector<GiNaC::ex> expressions = values_of(map.on);
  expressions.insert(expressions.end(), map.expressions.begin(), map.expressions.end());
  for (const GiNaC::ex& bracket : map.composed_brackets()) expressions.push_back(bracket);
  return expressions;
}

}  // namespace

std::vector<Claim> map_claims(const Model& model) {
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < model.maps.size(); ++i) {
    claims.push_back(
        {"map", model.maps[i].name, false,
         [i](Prover& prover, Proof& proof) { decide_map(prover, proof, prover.model().maps[i]); },
         names_of(model.maps[i].on), expressions_of(model.maps[i])});
  }
  return claims;
}

}  // namespace casimir
