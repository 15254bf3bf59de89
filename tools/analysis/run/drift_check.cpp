#include "tools/analysis/run/drift_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/analysis/proof/prove_in_process.hpp"

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

/// What a change says of an invariant that is not proved to be an integral.
std::string doubt(const std::string& name, double change, Verdict verdict) {
  return fmt::format("{} changes by {:.1e} of its size, and it is {} to be an integral", name,
                     change, verdict == Verdict::refuted ? "refuted" : "not proved");
}

}  // namespace

Proof proof_of(const Model& model, const std::string& invariant) {
  // Among the invariants H is the Hamiltonian, though the file may call a variable or a definition
  // that: here it gets a name that the file does not use.
  Model named = model;
  std::string name = invariant;
  if (invariant == "H" && model.hamiltonian) {
    while (declares(named, name)) name += "_";
    named.definitions.push_back({name, *model.hamiltonian, {}});
  }
  Candidates candidates;
  candidates.integrals.push_back({name, {"invariant", 1, 1}, name});
  const std::vector<Proof> proofs = prove_within(kSecondsOfCheck, named, candidates, {});
  return proofs.empty() ? Proof{} : proofs.front();
}

Verdict verdict_on(const Model& model, const std::string& invariant) {
  return proof_of(model, invariant).verdict;
}

DriftDoubts check_drift(const Model& model, const std::vector<std::string>& names,
                        Trajectory& trajectory) {
  DriftDoubts doubts;
  for (std::size_t i = 0; i < trajectory.invariants.size(); ++i) {
    const InvariantRecord& record = trajectory.invariants[i];
    if (record.drift <= record.allowed) continue;
    const Verdict verdict = verdict_on(model, names[i]);
    if (verdict != Verdict::proved) {
      doubts.which.push_back(i);
      doubts.sentences.push_back(doubt(names[i], record.drift, verdict));
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

std::vector<std::string> doubts_of_members(const Model& model,
                                           const std::vector<std::string>& names,
                                           const EnsembleResult& result, double rtol) {
  constexpr double kTimes = 1e4, kLeast = 1e-9;
  std::vector<std::string> doubts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    double drift = 0;
    for (const MemberResult& member : result.members)
      if (i < member.invariants.size()) drift = std::max(drift, member.invariants[i].drift);
    if (drift <= std::max(kLeast, kTimes * rtol)) continue;
    if (const Verdict verdict = verdict_on(model, names[i]); verdict != Verdict::proved)
      doubts.push_back(doubt(names[i], drift, verdict));
  }
  return doubts;
}

std::vector<std::string> doubts_of_orbit(const MapModel& map, const Iterated& orbit) {
  constexpr double kTimes = 100, kLeast = 1e-9;
  const double allowed = std::max(kLeast, kTimes * orbit.error_estimate.value_or(0));
  const auto changes = [&](const Iterated::Invariant& one) { return one.drift > allowed; };
  std::vector<std::string> doubts;
  if (std::ranges::none_of(orbit.invariants, changes)) return doubts;
  const std::vector<Proof> proofs = prove_within(kSecondsOfCheck, map, {}, {});
  for (const Iterated::Invariant& one : orbit.invariants) {
    if (!changes(one)) continue;
    const auto found = std::ranges::find_if(proofs, [&](const Proof& proof) {
      return proof.name == one.name &&
             (proof.kind == ClaimKind::integral || proof.kind == ClaimKind::conditional ||
              proof.kind == ClaimKind::casimir);
    });
    const Verdict verdict = found == proofs.end() ? Verdict::undecided : found->verdict;
    if (verdict != Verdict::proved) doubts.push_back(doubt(one.name, one.drift, verdict));
  }
  return doubts;
}

}  // namespace casimir
