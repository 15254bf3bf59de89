#include "symbolic/discrete/prove_map.hpp"

#include <memory>

#include "symbolic/discrete/map_claims.hpp"
#include "symbolic/discrete/prove_candidate.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/claim_kinds.hpp"
#include "symbolic/proof/run_claims.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> read_candidates(const Model& model, const std::vector<Text>& texts,
                                             const GivenFunctions& given) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(given.put(model.parse_named(text)));
  return result;
}

/// \param written  the case that candidates are read in
/// \param given  what `map` has for its arbitrary functions
std::vector<Claim> candidate_claims(const Model& written, const MapModel& map,
                                    const Candidates& candidates, const GivenFunctions& given) {
  const std::vector<NamedExpression> on = read_candidates(written, candidates.on, given);
  std::vector<Claim> claims;
  for (const ClaimRow& row : claim_rows()) {
    if (!row.candidates) continue;
    const std::vector<Text>& texts = candidates.*row.candidates;
    require_bracket(row, map.base, texts);
    for (const NamedExpression& f : read_candidates(written, texts, given))
      claims.push_back(row.make_of_map(map, f, on));
  }
  for (const Text& text : candidates.identities) {
    Identity identity = written.parse_identity(text);
    for (GiNaC::ex& part : identity.domain) part = given.put(part);
    given.put_into(identity.left, identity.domain);
    given.put_into(identity.right, identity.domain);
    identity.on = on;
    claims.push_back(identity_claim(identity));
  }
  return claims;
}

/// \param written, given  see `candidate_claims`
std::vector<Claim> claims_about(const Model& written, const MapModel& map,
                                const Candidates& candidates, const GivenFunctions& given) {
  if (!candidates.empty()) return candidate_claims(written, map, candidates, given);
  std::vector<Claim> claims;
  for (const ClaimRow& row : claim_rows()) {
    if (!row.read_of_map) continue;
    for (Claim& claim : row.read_of_map(map)) {
      if (!candidates.only || candidates.only == claim.kind) claims.push_back(std::move(claim));
    }
  }
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

std::vector<Claim> claims_about(const MapModel& map, const Candidates& candidates) {
  std::vector<Claim> claims = claims_about(map.base, map, candidates, {map.base.limits, {}, {}});
  for (Claim& claim : claims) {
    claim.decide = [decide = std::move(claim.decide)](Prover& prover, Proof& proof) {
      decide(prover, proof);
      shorten_conditions(proof);
    };
  }
  return claims;
}

}  // namespace

std::vector<Proof> prove_map(const MapModel& map, const Candidates& candidates,
                             const std::function<bool(const Proof&)>& report) {
  const std::vector<Claim> claims = claims_about(map, candidates);
  const Meaningless meaningless = candidates.empty() ? Meaningless::undecided : Meaningless::thrown;
  if (!has_arbitrary_functions(map.base))
    return decide_claims(map.base, claims, meaningless, report);
  // The claims refer to their maps.
  std::vector<std::unique_ptr<MapModel>> given_maps;
  return decide_claims_for_all(
      map.base, claims, meaningless, report, [&](const Model&, const GivenFunctions& given) {
        given_maps.push_back(std::make_unique<MapModel>(with_functions(map, given)));
        return claims_about(map.base, *given_maps.back(), candidates, given);
      });
}

std::vector<Proof> pending(const MapModel& map, const Candidates& candidates) {
  return pending_claims(claims_about(map, candidates));
}

Proof discrete::prove_integral(const MapModel& map, const NamedExpression& f) {
  return decide_claims(map.base, {integral_claim(map, f, {})}, Meaningless::thrown, {}).front();
}

std::optional<std::string> discrete::thin_domain_of(const MapModel& map) {
  std::vector<GiNaC::ex> functions = map.next;
  functions.insert(functions.end(), map.next_domain.begin(), map.next_domain.end());
  // Quotients of polynomials have values at almost all points, and may be large.
  std::erase_if(functions,
                [](const GiNaC::ex& f) { return f.info(GiNaC::info_flags::rational_function); });
  if (functions.empty() && map.base.assumptions.empty()) return std::nullopt;
  Prover prover(map.base, functions, Subject::functions);
  return thin_domain(prover);
}

std::string discrete::evidence_and_conditions(const Proof& proof) {
  std::string text = proof.evidence;
  for (const std::string& condition : proof.where)
    text += (text.empty() ? "where " : ", where ") + condition;
  return text;
}

Proof discrete::prove_density(const MapModel& map, const NamedExpression& density) {
  return decide_claims(map.base, {measure_claim(map, density)}, Meaningless::thrown, {}).front();
}

}  // namespace casimir
