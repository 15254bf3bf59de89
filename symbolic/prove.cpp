#include "symbolic/prove.hpp"

#include <chrono>
#include <stdexcept>

#include "symbolic/claims/claim.hpp"

namespace casimir {
namespace {

NamedExpression read(const Model& model, const Text& text) {
  return {text.value, model.parse(text), text.where};
}

std::vector<NamedExpression> read(const Model& model, const std::vector<Text>& texts) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(read(model, text));
  return result;
}

struct Work {
  std::vector<Claim> claims;
  std::vector<GiNaC::ex> expressions;  ///< of candidates, which the model does not hold
};

Work work_of(const Model& model, const Candidates& candidates) {
  Work work;
  if (candidates.empty()) {
    for (const ClaimKind& kind : kClaimKinds) {
      for (Claim& claim : kind(model)) {
        if (candidates.only.empty() || candidates.only == claim.kind)
          work.claims.push_back(std::move(claim));
      }
    }
    return work;
  }
  const std::vector<NamedExpression> on = read(model, candidates.on);
  const auto add = [&](const std::vector<Text>& texts, auto make_claim) {
    for (const NamedExpression& f : read(model, texts)) {
      work.claims.push_back(make_claim(f, on));
      work.expressions.push_back(f.value);
    }
  };
  if (!model.poisson && !candidates.casimirs.empty()) {
    throw candidates.casimirs[0].error(
        "a Casimir function needs a bracket, which this case does not have");
  }
  add(candidates.casimirs, casimir_claim);
  add(candidates.integrals, integral_claim);
  add(candidates.invariant_relations, invariant_relation_claim);
  for (const Text& text : candidates.identities) {
    const auto [left, right] = model.parse_equation(text);
    work.claims.push_back(identity_claim({text.value, text.where, left, right, on}));
  }
  if (on.empty()) {
    for (const auto* texts :
         {&candidates.casimirs, &candidates.integrals, &candidates.invariant_relations}) {
      for (const NamedExpression& f : read(model, *texts)) work.claims.push_back(judgement_note(f));
    }
  }
  for (const NamedExpression& f : on) work.expressions.push_back(f.value);
  return work;
}

Proof undecided(const Claim& claim) {
  Proof proof;
  proof.kind = claim.kind;
  proof.name = claim.name;
  proof.fact = claim.fact;
  proof.note = claim.note;
  proof.on = claim.on;
  return proof;
}

void decide(Prover& prover, const Claim& claim, Proof& proof) {
  const auto start = std::chrono::steady_clock::now();
  try {
    claim.decide(prover, proof);
  } catch (const TooLarge& limit) {
    proof.verdict = Verdict::undecided;
    proof.reason = limit.what();
  } catch (const std::overflow_error& limit) {
    proof.verdict = Verdict::undecided;
    proof.reason = limit.what();
  }
  proof.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::proved:
      return "proved";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

std::vector<Proof> pending(const Model& model, const Candidates& candidates) {
  std::vector<Proof> proofs;
  for (const Claim& claim : work_of(model, candidates).claims) proofs.push_back(undecided(claim));
  return proofs;
}

std::vector<Proof> prove(const Model& model, const Candidates& candidates,
                         const std::function<bool(const Proof&)>& report) {
  const Work work = work_of(model, candidates);
  std::optional<Prover> prover;
  std::string too_large;  // not even the expressions of the case fit
  try {
    std::vector<GiNaC::ex> expressions = work.expressions;
    for (const Claim& claim : work.claims)
      expressions.insert(expressions.end(), claim.expressions.begin(), claim.expressions.end());
    prover.emplace(model, expressions);
  } catch (const TooLarge& limit) {
    too_large = limit.what();
  }
  std::vector<Proof> proofs;
  for (const Claim& claim : work.claims) {
    proofs.push_back(undecided(claim));
    proofs.back().reason = too_large;
    if (prover) decide(*prover, claim, proofs.back());
    if (report && !report(proofs.back())) break;
  }
  return proofs;
}

bool counts(const Model& model, const Proof& proof) {
  return !proof.note && (!proof.fact || model.integrable);
}

Verdict overall(const Model& model, const std::vector<Proof>& proofs) {
  Verdict worst = Verdict::proved;
  for (const Proof& proof : proofs) {
    if (!counts(model, proof)) continue;
    if (proof.verdict == Verdict::refuted) return Verdict::refuted;
    if (proof.verdict == Verdict::undecided) worst = Verdict::undecided;
  }
  return worst;
}

}  // namespace casimir
