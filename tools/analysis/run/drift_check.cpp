#include "tools/analysis/run/drift_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

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
  candidates.judged = false;
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

std::string words_of_lost_invariant(const std::string& name) {
  return fmt::format(
      "{} has no value at some state of the run, or an infinite one, and says nothing of it", name);
}

namespace {

/// The largest change of an invariant, relative to its size, where the numbers of a state change by
/// so much of theirs, up or down.
double change_nearby(const PreparedScene& run, std::size_t invariant, double time,
                     const std::vector<double>& state, double by) {
  constexpr int kStates = 16;
  const InvariantTerms terms = run.invariant_terms();
  std::vector<long double> values(run.specialisation.invariant_names.size()), sizes = values;
  const auto value_at = [&](const std::vector<double>& x) {
    std::ranges::fill(sizes, 0);
    terms(time, x.data(), values.data(), sizes.data());
    return values[invariant];
  };
  const long double here = value_at(state);
  const long double size = std::max(std::abs(here), sizes[invariant]);
  std::mt19937_64 random;
  long double largest = 0;
  for (int i = 0; i < kStates; ++i) {
    std::vector<double> x = state;
    for (double& number : x) number *= 1 + ((random() >> 63) != 0 ? by : -by);
    const long double value = value_at(x);
    if (std::isnan(value)) continue;  // beside its domain, as sqrt(1 - x^2) beside x = 1
    largest = std::max(largest, std::abs(value - here) / size);
  }
  return static_cast<double>(largest);
}

/// Why the drift of an invariant says nothing of the run, a sentence; empty where it does: it has
/// no value at some state, or differs by as much between states that differ by what is allowed.
std::string why_it_says_nothing(const PreparedScene& run, std::size_t invariant,
                                const Trajectory& trajectory) {
  constexpr double kLeast = 4 * std::numeric_limits<double>::epsilon(), kMost = 1e-6;
  const InvariantRecord& record = trajectory.invariants[invariant];
  const std::string& name = run.specialisation.invariant_names[invariant];
  if (!std::isfinite(record.initial) || !std::isfinite(record.final))
    return words_of_lost_invariant(name);
  const double by = std::clamp(record.allowed, kLeast, kMost);
  const double nearby =
      std::max(change_nearby(run, invariant, 0, run.initial, by),
               change_nearby(run, invariant, trajectory.time, trajectory.state, by));
  if (record.drift <= nearby)
    return fmt::format(
        "{} changes by {:.1e} of its size where the numbers of a state change by {:.1e} of theirs, "
        "and says nothing of the run",
        name, nearby, by);
  // What is lost on the way says nothing where the end has the value of the start.
  const long double size = std::max(std::abs(record.initial), std::abs(record.final));
  const bool is_kept = std::abs(record.final - record.initial) <= std::max(by, nearby) * size;
  return !std::isfinite(record.drift) && is_kept ? words_of_lost_invariant(name) : std::string{};
}

}  // namespace

DriftDoubts check_drift(const Model& model, const Scene& scene, const PreparedScene& run,
                        Trajectory& trajectory) {
  const std::vector<std::string>& names = run.specialisation.invariant_names;
  DriftDoubts doubts;
  for (std::size_t i = 0; i < trajectory.invariants.size(); ++i) {
    const InvariantRecord& record = trajectory.invariants[i];
    if (record.drift <= record.allowed) continue;
    if (std::string why = why_it_says_nothing(run, i, trajectory); !why.empty()) {
      doubts.which.push_back(i);
      doubts.sentences.push_back(std::move(why));
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
