#include "symbolic/discrete/prove_map.hpp"

#include "symbolic/discrete/map_claims.hpp"
#include "symbolic/discrete/prove_candidate.hpp"
#include "symbolic/proof/run_claims.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> read_candidates(const Model& model, const std::vector<Text>& texts) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(model.parse_named(text));
  return result;
}

std::vector<Claim> candidate_claims(const MapModel& map, const Candidates& candidates) {
  const std::vector<NamedExpression> on = read_candidates(map.base, candidates.on);
  if (!map.base.poisson && !candidates.casimirs.empty()) {
    throw candidates.casimirs[0].error(
        "a Casimir function needs a bracket, which this case does not have");
  }
  std::vector<Claim> claims;
  for (const NamedExpression& f : read_candidates(map.base, candidates.casimirs)) {
    claims.push_back(casimir_claim(f, on));
    claims.back().subject = Subject::bracket;
  }
  for (const NamedExpression& f : read_candidates(map.base, candidates.integrals))
    claims.push_back(discrete::integral_claim(map, f, on));
  for (const NamedExpression& f : read_candidates(map.base, candidates.invariant_relations))
    claims.push_back(discrete::invariant_relation_claim(map, f, on));
  for (const Text& text : candidates.identities) {
    Identity identity = map.base.parse_identity(text);
    identity.on = on;
    claims.push_back(identity_claim(identity));
  }
  return claims;
}

std::vector<Claim> claims_about(const MapModel& map, const Candidates& candidates) {
  if (!candidates.empty()) return candidate_claims(map, candidates);
  const Model& model = map.base;
  std::vector<Claim> claims;
  const auto append = [&](std::vector<Claim> more) {
    for (Claim& claim : more) claims.push_back(std::move(claim));
  };
  append(skew_claims(model));
  append(jacobi_claims(model));
  append(frame_claims(model));
  if (model.poisson) claims.push_back(discrete::poisson_claim(map));
  append(casimir_claims(model));
  // A Poisson map carries leaves into leaves, but it may exchange them.
  for (const auto* list : {&model.casimirs, &model.integrals}) {
    for (const NamedExpression& f : *list) claims.push_back(discrete::integral_claim(map, f, {}));
  }
  for (const LevelClaim& level : model.conditionals) {
    claims.push_back(discrete::integral_claim(map, level.expression, level.on));
    claims.back().kind = ClaimKind::conditional;
  }
  if (!model.constraints.empty()) {
    const std::vector<NamedExpression> others(model.constraints.begin(),
                                              model.constraints.end() - 1);
    claims.push_back(discrete::invariant_relation_claim(map, model.constraints.back(), others));
    claims.back().name = "constraints";
  }
  for (const LevelClaim& level : model.invariant_relations)
    claims.push_back(discrete::invariant_relation_claim(map, level.expression, level.on));
  for (const Measure& measure : model.measures)
    claims.push_back(discrete::measure_claim(map, measure.density));
  for (const MapSymmetry& symmetry : map.symmetries)
    claims.push_back(discrete::symmetry_claim(map, symmetry));
  append(identity_claims(model));
  append(involution_claims(model));
  append(independence_claims(model));
  append(rank_claims(model));
  append(discrete::liouville_claims(map));
  if (candidates.only)
    std::erase_if(claims, [&](const Claim& claim) { return claim.kind != *candidates.only; });
  return claims;
}

/// Denominators that nobody reads in one line for all of them: those of a map are long, and those
/// at its image longer.
void shorten_conditions(Proof& proof) {
  constexpr std::size_t kReadable = 160;
  const std::size_t before = proof.nonzero.size();
  std::erase_if(proof.nonzero,
                [](const std::string& condition) { return condition.size() > kReadable; });
  if (proof.nonzero.size() < before)
    proof.nonzero.emplace_back("the longer denominators of the map and the claim");
}

}  // namespace

std::vector<Proof> prove_map(const MapModel& map, const Candidates& candidates,
                             const std::function<bool(const Proof&)>& report) {
  std::vector<Claim> claims = claims_about(map, candidates);
  for (Claim& claim : claims) {
    claim.decide = [decide = std::move(claim.decide)](Prover& prover, Proof& proof) {
      decide(prover, proof);
      shorten_conditions(proof);
    };
  }
  return decide_claims(map.base, claims, report);
}

std::vector<Proof> pending(const MapModel& map, const Candidates& candidates) {
  return pending_claims(claims_about(map, candidates));
}

Proof discrete::prove_integral(const MapModel& map, const NamedExpression& f) {
  return decide_claims(map.base, {integral_claim(map, f, {})}, {}).front();
}

Proof discrete::prove_density(const MapModel& map, const NamedExpression& density) {
  return decide_claims(map.base, {measure_claim(map, density)}, {}).front();
}

}  // namespace casimir
