#include "tools/analysis/run/doubted_invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/analysis/proof/prove_in_process.hpp"

namespace casimir {

std::string doubt_of_invariant(const std::string& name, double change,
                               const KnownInvariant& known) {
  return fmt::format("{} changes by {:.1e} of its size, and it is {}", name, change,
                     words_of(known));
}

std::vector<std::string> doubts_of_drifts(const Model& model, const Scene& scene,
                                          const std::vector<std::string>& names,
                                          const std::vector<double>& drifts, double rtol) {
  constexpr double kTimes = 1e4, kLeast = 1e-9;
  std::vector<std::string> doubts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (drifts[i] <= std::max(kLeast, kTimes * rtol)) continue;
    const KnownInvariant known = known_invariant(model, scene, names[i]);
    if (known.proof.verdict != Verdict::proved)
      doubts.push_back(doubt_of_invariant(names[i], drifts[i], known));
  }
  return doubts;
}

std::vector<std::string> doubts_of_members(const Model& model, const Scene& scene,
                                           const std::vector<std::string>& names,
                                           const EnsembleResult& result, double rtol) {
  std::vector<double> drifts(names.size());
  for (const MemberResult& member : result.members)
    for (std::size_t i = 0; i < std::min(names.size(), member.invariants.size()); ++i)
      drifts[i] = std::max(drifts[i], member.invariants[i].drift);
  return doubts_of_drifts(model, scene, names, drifts, rtol);
}

std::vector<std::string> doubts_of_orbit(const MapModel& map, const Iterated& orbit) {
  constexpr double kTimes = 100, kLeast = 1e-9, kSecondsForOrbit = 10;
  const double allowed = std::max(kLeast, kTimes * orbit.error_estimate.value_or(0));
  const auto changes = [&](const Iterated::Invariant& one) { return one.drift > allowed; };
  std::vector<std::string> doubts;
  if (std::ranges::none_of(orbit.invariants, changes)) return doubts;
  const auto says_something = [&](const Iterated::Invariant& one) {
    return changes(one) && std::isfinite(one.drift);
  };
  const std::vector<Proof> proofs = std::ranges::any_of(orbit.invariants, says_something)
                                        ? prove_within(kSecondsForOrbit, map, {}, {})
                                        : std::vector<Proof>{};
  for (const Iterated::Invariant& one : orbit.invariants) {
    if (!changes(one)) continue;
    if (!std::isfinite(one.drift)) {
      doubts.push_back(words_of_lost_invariant(one.name));
      continue;
    }
    const auto found = std::ranges::find_if(proofs, [&](const Proof& proof) {
      return proof.name == one.name &&
             (proof.kind == ClaimKind::integral || proof.kind == ClaimKind::conditional ||
              proof.kind == ClaimKind::casimir);
    });
    const KnownInvariant known{found == proofs.end() ? Proof{} : *found};
    if (known.proof.verdict != Verdict::proved)
      doubts.push_back(doubt_of_invariant(one.name, one.drift, known));
    else
      doubts.push_back(fmt::format(
          "{} is proved to be an integral, but drifted by {:.0e}: rounding has moved the orbit by "
          "more than is estimated of its end",
          one.name, one.drift));
  }
  return doubts;
}

std::string doubt_of_end(const Iterated& orbit) {
  if (orbit.error_estimate && *orbit.error_estimate >= kSpoiledOrbit)
    return "rounding has grown to the size of the state: the last state is that of no orbit that "
           "begins where the scene does";
  if (!orbit.error_estimate && orbit.finite && !orbit.stopped)
    return fmt::format(
        "how far rounding moved the last state is not estimated: that takes the time of three such "
        "orbits, "
        "and this one took more than {:g} s",
        kLongestRepeated);
  return {};
}

}  // namespace casimir
