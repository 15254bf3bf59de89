#include "symbolic/prove.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <new>
#include <stdexcept>

#include "symbolic/case/limits.hpp"
#include "symbolic/proof/run_claims.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> read(const Model& model, const std::vector<Text>& texts) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(model.parse_named(text));
  return result;
}

std::vector<Claim> claims_of(const Model& model, const Candidates& candidates) {
  std::vector<Claim> claims;
  if (candidates.empty()) {
    for (const ReadClaims& read_claims : kClaimReaders) {
      for (Claim& claim : read_claims(model)) {
        if (!candidates.only || candidates.only == claim.kind) claims.push_back(std::move(claim));
      }
    }
    return claims;
  }
  const std::vector<NamedExpression> on = read(model, candidates.on);
  const auto add = [&](const std::vector<Text>& texts, auto make_claim) {
    for (const NamedExpression& f : read(model, texts)) {
      claims.push_back(make_claim(f, on));
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
    Identity identity = model.parse_identity(text);
    identity.on = on;
    claims.push_back(identity_claim(identity));
  }
  if (on.empty()) {
    for (const auto* texts :
         {&candidates.casimirs, &candidates.integrals, &candidates.invariant_relations}) {
      for (const NamedExpression& f : read(model, *texts))
        claims.push_back(judgement_note(model, f));
    }
  }
  return claims;
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
  } catch (const NotCertified&) {
    proof.verdict = Verdict::undecided;
    proof.reason = "a function has no value that is certain at the points tried";
  } catch (const std::bad_alloc&) {
    proof.verdict = Verdict::undecided;
    proof.reason = out_of_memory();
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

namespace {

constexpr std::array<std::pair<ClaimKind, const char*>, 15> kKindNames = {{
    {ClaimKind::skew, "skew"},
    {ClaimKind::jacobi, "jacobi"},
    {ClaimKind::casimir, "casimir"},
    {ClaimKind::integral, "integral"},
    {ClaimKind::conditional, "conditional"},
    {ClaimKind::invariant_relation, "invariant_relation"},
    {ClaimKind::lax, "lax"},
    {ClaimKind::map, "map"},
    {ClaimKind::measure, "measure"},
    {ClaimKind::identity, "identity"},
    {ClaimKind::involution, "involution"},
    {ClaimKind::independence, "independence"},
    {ClaimKind::rank, "rank"},
    {ClaimKind::liouville, "liouville"},
    {ClaimKind::judgement, "judgement"},
}};

}  // namespace

std::string to_string(ClaimKind kind) {
  for (const auto& [known, name] : kKindNames) {
    if (known == kind) return name;
  }
  return {};
}

std::optional<ClaimKind> claim_kind_of(const std::string& name) {
  for (const auto& [kind, known] : kKindNames) {
    if (name == known) return kind;
  }
  return std::nullopt;
}

std::vector<Proof> pending_claims(const std::vector<Claim>& claims) {
  std::vector<Proof> proofs;
  for (const Claim& claim : claims) proofs.push_back(undecided(claim));
  return proofs;
}

std::vector<Proof> pending(const Model& model, const Candidates& candidates) {
  return pending_claims(claims_of(model, candidates));
}

namespace {

/// What decides the claims: one prover for all of them; but where a root or a logarithm makes some
/// function positive, or one of them has complex numbers, a prover for each, so that no proof rests
/// on the domain of another claim.
class Provers {
 public:
  Provers(const Model& model, const std::vector<Claim>& claims) : model_(model) {
    std::vector<GiNaC::ex> all;
    for (const Claim& claim : claims)
      all.insert(all.end(), claim.expressions.begin(), claim.expressions.end());
    try {
      const WorkMeter meter;
      shared_.emplace(model, all);
      if (shared_->ring().implied_positive().empty() && !shared_->ring().is_complex()) return;
      shared_.reset();
    } catch (const TooLarge&) {
      shared_.reset();  // a single claim may be small enough
    } catch (const std::bad_alloc&) {
      shared_.reset();
    }
  }

  void decide(const Claim& claim, Proof& proof) {
    try {
      const WorkMeter meter;
      if (!shared_) own_.emplace(model_, claim.expressions, claim.subject);
      Prover& prover = shared_ ? *shared_ : *own_;
      prover.begin_claim(claim.expressions, claim.subject);
      casimir::decide(prover, claim, proof);
    } catch (const TooLarge& limit) {
      proof.reason = limit.what();
    } catch (const std::bad_alloc&) {
      proof.reason = out_of_memory();
    }
  }

 private:
  const Model& model_;
  std::optional<Prover> shared_, own_;
};

}  // namespace

Proof prove_claim(const Model& model, ClaimKind kind, const NamedExpression& f,
                  const std::vector<NamedExpression>& on) {
  const auto claim = [&]() -> Claim {
    switch (kind) {
      case ClaimKind::casimir:
        if (!model.poisson)
          throw ModelError("a Casimir function needs a bracket, which this case does not have");
        return casimir_claim(f, on);
      case ClaimKind::integral:
      case ClaimKind::conditional:
        return integral_claim(f, on);
      case ClaimKind::invariant_relation:
        return invariant_relation_claim(f, on);
      default:
        throw ModelError(
            fmt::format("a claim of the kind '{}' is not about one function", to_string(kind)));
    }
  }();
  Proof proof = undecided(claim);
  Provers(model, {claim}).decide(claim, proof);
  return proof;
}

std::vector<Proof> prove(const Model& model, const Candidates& candidates,
                         const std::function<bool(const Proof&)>& report) {
  return decide_claims(model, claims_of(model, candidates), report);
}

std::vector<Proof> decide_claims(const Model& model, const std::vector<Claim>& claims,
                                 const std::function<bool(const Proof&)>& report) {
  Provers provers(model, claims);
  std::vector<Proof> proofs;
  for (const Claim& claim : claims) {
    proofs.push_back(undecided(claim));
    provers.decide(claim, proofs.back());
    if (report && !report(proofs.back())) break;
  }
  return proofs;
}

bool counts(const Model& model, const Proof& proof) {
  if (proof.note || !proof.fact) return !proof.note;
  // Integrals that do not commute, and those that follow from others, are no fault there.
  if (model.superintegrable)
    return proof.kind == ClaimKind::rank || proof.kind == ClaimKind::liouville;
  return model.integrable;
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
