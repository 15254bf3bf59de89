#include "tools/analysis/run/drift_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "symbolic/model/given_functions.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"
#include "tools/analysis/run/doubted_invariants.hpp"

namespace casimir {
namespace {

constexpr double kSecondsOfCheck = 10;

bool declares(const Model& model, const std::string& name) {
  try {
    model.parse({name, {"invariant", 1, 1}, name});
    return true;
  } catch (const CaseError&) {
    return false;
  }
}

}  // namespace

KnownInvariant known_invariant(const Model& model, const Scene& scene,
                               const std::string& invariant) {
  // Among the invariants H is the Hamiltonian, though the file may call a variable or a definition
  // that: here it gets a name that the file does not use.
  Model named = model_in_scene(model, scene);
  std::string name = invariant;
  if (invariant == "H" && named.hamiltonian) {
    while (declares(named, name)) name += "_";
    named.definitions.push_back({name, *named.hamiltonian, {}});
  }
  Candidates candidates;
  candidates.integrals.push_back({name, {"invariant", 1, 1}, name});
  const auto proof_in = [&](const Model& where) {
    const std::vector<Proof> proofs = prove_within(kSecondsOfCheck, where, candidates, {});
    return proofs.empty() ? Proof{} : proofs.front();
  };
  const Model all = anywhere(named);
  KnownInvariant known{proof_in(all)};
  if (known.proof.verdict != Verdict::proved && all.assumptions.size() < named.assumptions.size())
    known.on_domain = proof_in(named).verdict == Verdict::proved;
  return known;
}

std::string words_of(const KnownInvariant& known) {
  if (known.on_domain)
    return "proved to be an integral on the domain of the case alone, which a motion may leave";
  return fmt::format("{} to be an integral",
                     known.proof.verdict == Verdict::refuted ? "refuted" : "not proved");
}

DriftDoubts check_drift(const Model& model, const Scene& scene,
                        const std::vector<std::string>& names, Trajectory& trajectory) {
  DriftDoubts doubts;
  for (std::size_t i = 0; i < trajectory.invariants.size(); ++i) {
    const InvariantRecord& record = trajectory.invariants[i];
    if (record.drift <= record.allowed) continue;
    if (std::isnan(record.initial)) {
      doubts.which.push_back(i);
      doubts.sentences.push_back(
          fmt::format("{} has no value where the run begins, and says nothing of it", names[i]));
      continue;
    }
    const KnownInvariant known = known_invariant(model, scene, names[i]);
    const Proof& proof = known.proof;
    if (proof.verdict != Verdict::proved) {
      doubts.which.push_back(i);
      doubts.sentences.push_back(doubt_of_invariant(names[i], record.drift, known));
    } else if (!proof.jumps.empty()) {
      doubts.which.push_back(i);
      doubts.sentences.push_back(fmt::format(
          "{} changes by {:.1e} of its size: it is an integral between the jumps that it may "
          "have where {}, so that this says nothing of the run",
          names[i], record.drift, fmt::join(proof.jumps, ", ")));
    } else if (trajectory.status == Status::ok) {
      trajectory.status = Status::drift_exceeded;
      trajectory.reason = fmt::format(
          "{} is proved to be an integral, but drifted by {:.1e} of its size, where the tolerance "
          "allows {:.1e}",
          names[i], record.drift, record.allowed);
    }
  }
  return doubts;
}

}  // namespace casimir
