#include "tools/analysis/proof/proved_facts.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"

namespace casimir {
namespace {

constexpr double kSecondsOfFact = 10;

/// Of the claims and facts of one kind.
std::vector<Proof> proofs_of(const Model& model, ClaimKind kind) {
  Candidates candidates;
  candidates.only = kind;
  return prove_within(kSecondsOfFact, model, candidates, {});
}

/// Of all of them: the worst. Undecided where there are none, and where one is proved with a
/// condition that `is_free` does not free it from.
Verdict verdict_on(const std::vector<Proof>& proofs,
                   const std::function<bool(const Proof&)>& is_free) {
  const auto refuted = [](const Proof& proof) { return proof.verdict == Verdict::refuted; };
  const auto proved = [&](const Proof& proof) {
    return proof.verdict == Verdict::proved && (proof.where.empty() || is_free(proof));
  };
  if (std::ranges::any_of(proofs, refuted)) return Verdict::refuted;
  return !proofs.empty() && std::ranges::all_of(proofs, proved) ? Verdict::proved
                                                                : Verdict::undecided;
}

}  // namespace

Verdict verdict_on_jacobi(const Model& model, const Scene& scene) {
  if (!model.poisson) return Verdict::undecided;
  const std::vector<Proof> proofs = proofs_of(model_in_scene(model, scene), ClaimKind::jacobi);
  const bool jumps =
      std::ranges::any_of(proofs, [](const Proof& proof) { return !proof.jumps.empty(); });
  return jumps ? Verdict::undecided : verdict_on(proofs, [](const Proof&) { return false; });
}

std::vector<NamedExpression> proved_invariants(const Model& model) {
  std::vector<NamedExpression> result;
  for (const auto& [kind, functions] : {std::pair{ClaimKind::casimir, &model.casimirs},
                                        std::pair{ClaimKind::integral, &model.integrals}}) {
    const std::vector<Proof> proofs = proofs_of(model, kind);
    for (const NamedExpression& function : *functions)
      if (std::ranges::any_of(proofs, [&name = function.name](const Proof& proof) {
            return proof.name == name && proof.verdict == Verdict::proved && proof.where.empty();
          }))
        result.push_back(function);
  }
  return result;
}

Verdict verdict_on_identities(const Model& model, std::vector<Identity> identities) {
  Model own = model;
  own.identities = std::move(identities);
  // Conditions u != 0 leave out surfaces alone; conditions u >= 0 leave out one side.
  return verdict_on(proofs_of(own, ClaimKind::identity), [](const Proof& proof) {
    return proof.positive.empty() && proof.not_zero.empty();
  });
}

}  // namespace casimir
