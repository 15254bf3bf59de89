#include "symbolic/prove.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/claim_kinds.hpp"
#include "symbolic/proof/run_claims.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> put(const std::vector<NamedExpression>& list,
                                 const GivenFunctions& given) {
  std::vector<NamedExpression> result;
  for (const NamedExpression& f : list) result.push_back(given.put(f));
  return result;
}

std::vector<NamedExpression> read(const Model& model, const std::vector<Text>& texts,
                                  const GivenFunctions& given) {
  std::vector<NamedExpression> result;
  for (const Text& text : texts) result.push_back(given.put(model.parse_named(text)));
  return result;
}

std::vector<Claim> claims_of_file(const Model& model, std::optional<ClaimKind> only) {
  std::vector<Claim> claims;
  for (const ClaimRow& row : claim_rows()) {
    if (!row.read) continue;
    for (Claim& claim : row.read(model)) {
      if (!only || only == claim.kind) claims.push_back(std::move(claim));
    }
  }
  return claims;
}

/// \param written  the case that candidates are read in
/// \param given  what `model` has for its arbitrary functions
std::vector<Claim> claims_of(const Model& written, const Model& model, const Candidates& candidates,
                             const GivenFunctions& given) {
  if (candidates.empty()) return claims_of_file(model, candidates.only);
  const std::vector<NamedExpression> on = read(written, candidates.on, given);
  std::vector<Claim> claims, notes;
  for (const ClaimRow& row : claim_rows()) {
    if (!row.candidates) continue;
    const std::vector<Text>& texts = candidates.*row.candidates;
    require_bracket(row, model, texts);
    for (const NamedExpression& f : read(written, texts, given)) {
      claims.push_back(row.make(f, on));
      if (on.empty() && candidates.judged) notes.push_back(judgement_note(model, f));
    }
  }
  for (const Text& text : candidates.identities) {
    Identity identity = written.parse_identity(text);
    for (GiNaC::ex& part : identity.domain) part = given.put(part);
    given.put_into(identity.left, identity.domain);
    given.put_into(identity.right, identity.domain);
    identity.on = on;
    claims.push_back(identity_claim(identity));
  }
  std::move(notes.begin(), notes.end(), std::back_inserter(claims));
  return claims;
}

std::vector<Claim> claims_of(const Model& model, const Candidates& candidates) {
  return claims_of(model, model, candidates, {model.limits, {}, {}});
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

/// Equations that are assumed keep witnesses out, and no proof uses them.
std::string hint_at_equations(const Model& model) {
  for (const Assumption& a : model.assumptions)
    if (a.comparison == Comparison::equal)
      return fmt::format(
          "; the equation '{}' is assumed and not put into the claims: a definition in the place "
          "of "
          "a parameter does that",
          a.text);
  return {};
}

void decide(Prover& prover, const Claim& claim, Proof& proof) {
  const auto start = std::chrono::steady_clock::now();
  try {
    claim.decide(prover, proof);
  } catch (const TooLarge& beyond) {
    proof.verdict = Verdict::undecided;
    proof.reason = beyond.what();
    proof.limit = beyond.limit();
  } catch (const std::overflow_error& limit) {
    proof.verdict = Verdict::undecided;
    proof.reason = limit.what();
  } catch (const NotCertified&) {
    proof.verdict = Verdict::undecided;
    proof.reason = "a function has no value that is certain at the points tried";
  } catch (const std::bad_alloc&) {
    proof.verdict = Verdict::undecided;
    proof.reason = prover.model().limits.out_of_memory();
  }
  if (proof.verdict == Verdict::undecided) proof.reason += hint_at_equations(prover.model());
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
/// function positive or other than zero, or one of them has complex numbers, a prover for each, so
/// that no proof rests on the domain of another claim.
class Provers {
 public:
  /// \param inhabited  that the claims are about something is shown elsewhere
  Provers(const Model& model, const std::vector<Claim>& claims, bool inhabited = false)
      : model_(model), inhabited_(inhabited) {
    std::vector<GiNaC::ex> all;
    for (const Claim& claim : claims)
      all.insert(all.end(), claim.expressions.begin(), claim.expressions.end());
    try {
      const WorkMeter meter(model.limits);
      shared_.emplace(model, all);
      const FunctionRing& ring = shared_->ring();
      if (!ring.rests_on_what_was_converted() && !ring.is_complex()) return;
      shared_.reset();
    } catch (const ModelError&) {
      // A single claim may be small enough, and have values where another has none.
      shared_.reset();
    } catch (const std::bad_alloc&) {
      shared_.reset();
    }
  }

  /// \throws ModelError  for a claim that has no meaning, as one that divides by what is zero
  ///     everywhere
  void decide(const Claim& claim, Proof& proof) {
    try {
      const WorkMeter meter(model_.limits);
      if (!shared_) {
        own_.emplace(model_, claim.expressions, claim.subject);
        own_->share(on_constraints_);
      }
      Prover& prover = shared_ ? *shared_ : *own_;
      prover.begin_claim(claim.expressions, claim.subject);
      prover.take_as_inhabited(inhabited_);
      casimir::decide(prover, claim, proof);
    } catch (const TooLarge& beyond) {
      proof.reason = beyond.what();
      proof.limit = beyond.limit();
    } catch (const std::bad_alloc&) {
      proof.reason = model_.limits.out_of_memory();
    }
  }

 private:
  const Model& model_;
  bool inhabited_;
  std::optional<Prover> shared_, own_;
  std::shared_ptr<PointsOfConstraints> on_constraints_ = std::make_shared<PointsOfConstraints>();
};

/// Decides a claim; where it has no meaning, by `meaningless`. A note is about other claims, too.
void decide_or_leave(const Model& model, Meaningless meaningless, Proof& proof,
                     const std::function<void(Proof&)>& decide) {
  if (meaningless == Meaningless::thrown && !proof.note) return decide(proof);
  const Proof before = proof;
  const auto leave = [&](std::string reason) {
    const Prover has_meaning(model, {});  // of the case, else this throws
    proof = before;
    proof.reason = std::move(reason);
  };
  try {
    decide(proof);
  } catch (const NoValue& nowhere) {
    leave(fmt::format("what it is about has a value nowhere: {}", nowhere.what()));
  } catch (const ModelError& error) {
    leave(error.what());
  }
}

/// The claims of a case with arbitrary functions, for functions that are given.
struct GivenCase {
  GivenFunctions given;
  std::unique_ptr<Model> model;
  std::vector<Claim> claims;
  std::unique_ptr<Provers> provers;
};

/// \param count  of the claims
/// \param make  the claims of the case that it is given, in the order of the others
std::vector<GivenCase> given_cases(
    const Model& model, std::size_t count,
    const std::function<std::vector<Claim>(const Model&, const GivenFunctions&)>& make) {
  std::vector<GivenCase> result;
  for (GivenFunctions& given : function_choices(model)) {
    try {
      GivenCase own{std::move(given), nullptr, {}, nullptr};
      own.model = std::make_unique<Model>(with_functions(model, own.given));
      own.claims = make(*own.model, own.given);
      if (own.claims.size() != count) continue;
      own.provers = std::make_unique<Provers>(*own.model, own.claims);
      result.push_back(std::move(own));
    } catch (const ModelError&) {  // these functions have no meaning there
    } catch (const GiNaC::pole_error&) {
    }
  }
  return result;
}

/// Decides a claim about arbitrary functions U.
///
/// That it holds for all of them is proved where it follows from the rules of differentiation
/// alone; since nothing is known of a U, that the claim is about something is shown for one U. That
/// it does not hold for all is shown by a polynomial for U and a witness for that.
void decide_for_all(Provers& provers, std::vector<GivenCase>& cases, const Claim& claim,
                    std::size_t index, Proof& proof) {
  provers.decide(claim, proof);
  if (proof.verdict == Verdict::refuted) {  // it does not speak of them
    if (proof.witness)
      std::erase_if(proof.witness->point,
                    [](const auto& value) { return function_name(value.first).has_value(); });
    return;
  }
  const bool proved = proof.verdict == Verdict::proved;
  bool seen = false;
  for (GivenCase& own : cases) {
    if ((proved && seen) || (proof.fact && !proved)) continue;
    Proof given = undecided(own.claims[index]);
    own.provers->decide(own.claims[index], given);
    seen = seen || given.verdict == Verdict::proved;
    if (given.verdict != Verdict::refuted || !given.witness) continue;
    given.witness->point.insert(given.witness->point.end(), own.given.texts.begin(),
                                own.given.texts.end());
    given.seconds += proof.seconds;
    proof = std::move(given);
    return;
  }
  if (!proved || seen) return;
  proof.verdict = Verdict::undecided;
  proof.evidence.clear();
  proof.where.clear();
  proof.reason = "no function was found for which the claim is about something";
}

}  // namespace

Proof prove_claim(const Model& model, ClaimKind kind, const NamedExpression& f,
                  const std::vector<NamedExpression>& on) {
  const ClaimRow& row = claim_row(kind);
  if (!row.make)
    throw ModelError(fmt::format("a claim of the kind '{}' is not about one function", row.name));
  if (row.without_bracket && !model.poisson) throw ModelError(row.without_bracket);
  const Claim claim = row.make(f, on);
  Proof proof = undecided(claim);
  if (!has_arbitrary_functions(model)) {
    Provers(model, {claim}).decide(claim, proof);
    return proof;
  }
  Provers provers(model, {claim}, true);
  std::vector<GivenCase> cases =
      given_cases(model, 1, [&](const Model&, const GivenFunctions& given) {
        return std::vector<Claim>{row.make(given.put(f), put(on, given))};
      });
  decide_for_all(provers, cases, claim, 0, proof);
  return proof;
}

std::vector<Proof> prove(const Model& model, const Candidates& candidates,
                         const std::function<bool(const Proof&)>& report) {
  const std::vector<Claim> claims = claims_of(model, candidates);
  const Meaningless meaningless = candidates.empty() ? Meaningless::undecided : Meaningless::thrown;
  if (!has_arbitrary_functions(model)) return decide_claims(model, claims, meaningless, report);
  return decide_claims_for_all(model, claims, meaningless, report,
                               [&](const Model& own, const GivenFunctions& given) {
                                 return claims_of(model, own, candidates, given);
                               });
}

std::vector<Proof> decide_claims_for_all(
    const Model& model, const std::vector<Claim>& claims, Meaningless meaningless,
    const std::function<bool(const Proof&)>& report,
    const std::function<std::vector<Claim>(const Model&, const GivenFunctions&)>& make) {
  Provers provers(model, claims, true);
  std::vector<GivenCase> cases = given_cases(model, claims.size(), make);
  std::vector<Proof> proofs;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    proofs.push_back(undecided(claims[i]));
    decide_or_leave(model, meaningless, proofs.back(),
                    [&](Proof& proof) { decide_for_all(provers, cases, claims[i], i, proof); });
    if (report && !report(proofs.back())) break;
  }
  return proofs;
}

std::vector<Proof> decide_claims(const Model& model, const std::vector<Claim>& claims,
                                 Meaningless meaningless,
                                 const std::function<bool(const Proof&)>& report) {
  Provers provers(model, claims);
  std::vector<Proof> proofs;
  for (const Claim& claim : claims) {
    proofs.push_back(undecided(claim));
    decide_or_leave(model, meaningless, proofs.back(),
                    [&](Proof& proof) { provers.decide(claim, proof); });
    if (report && !report(proofs.back())) break;
  }
  return proofs;
}

bool counts(const Model& model, const Proof& proof) {
  if (proof.note || !proof.fact) return !proof.note;
  // Integrals that do not commute, and those that follow from others, are no fault there.
  if (model.superintegrable) return claim_row(proof.kind).of_leaves;
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
