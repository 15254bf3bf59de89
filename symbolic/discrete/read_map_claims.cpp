// What the case file of a map claims, each kind by a function of its own.
#include "symbolic/discrete/map_claims.hpp"

namespace casimir::discrete {

std::vector<Claim> poisson_claims(const MapModel& map) {
  if (!map.base.poisson) return {};
  return {poisson_claim(map)};
}

/// A Poisson map carries leaves into leaves, but it may exchange them.
std::vector<Claim> integral_claims(const MapModel& map) {
  std::vector<Claim> claims;
  for (const auto* list : {&map.base.casimirs, &map.base.integrals}) {
    for (const NamedExpression& f : *list) claims.push_back(integral_claim(map, f, {}));
  }
  return claims;
}

std::vector<Claim> conditional_claims(const MapModel& map) {
  std::vector<Claim> claims;
  for (const LevelClaim& level : map.base.conditionals) {
    claims.push_back(integral_claim(map, level.expression, level.on));
    claims.back().kind = ClaimKind::conditional;
  }
  return claims;
}

std::vector<Claim> invariant_relation_claims(const MapModel& map) {
  std::vector<Claim> claims;
  const std::vector<NamedExpression>& constraints = map.base.constraints;
  if (!constraints.empty()) {
    const std::vector<NamedExpression> others(constraints.begin(), constraints.end() - 1);
    claims.push_back(invariant_relation_claim(map, constraints.back(), others));
    claims.back().name = "constraints";
  }
  for (const LevelClaim& level : map.base.invariant_relations)
    claims.push_back(invariant_relation_claim(map, level.expression, level.on));
  return claims;
}

std::vector<Claim> measure_claims(const MapModel& map) {
  std::vector<Claim> claims;
  for (const Measure& measure : map.base.measures)
    claims.push_back(measure_claim(map, measure.density));
  return claims;
}

std::vector<Claim> symmetry_claims(const MapModel& map) {
  std::vector<Claim> claims;
  for (const MapSymmetry& symmetry : map.symmetries)
    claims.push_back(symmetry_claim(map, symmetry));
  return claims;
}

std::vector<Claim> conjugacy_claims(const MapModel& map) {
  std::vector<Claim> claims;
  for (const MapConjugacy& conjugacy : map.conjugacies)
    claims.push_back(conjugacy_claim(map, conjugacy));
  return claims;
}

}  // namespace casimir::discrete
