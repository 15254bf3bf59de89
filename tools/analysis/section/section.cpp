#include "tools/analysis/section/section.hpp"

#include <fmt/format.h>

#include "tools/analysis/error.hpp"
#include "tools/analysis/proof/proved_facts.hpp"
#include "tools/analysis/section/domain_orbits.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"

namespace casimir {

std::size_t PoincareSection::crossings() const {
  std::size_t sum = 0;
  for (const OrbitReport& orbit : orbits) sum += orbit.places.size();
  return sum;
}

namespace {

/// \throws RequestError  for a state that is not on the level
std::vector<LevelSet::Vector> checked_seeds(const LevelSet& level,
                                            const std::vector<std::vector<double>>& states) {
  std::vector<LevelSet::Vector> seeds;
  for (const std::vector<double>& state : states) {
    const std::size_t number = seeds.size() + 1, wanted = level.problem().states();
    if (state.size() != wanted)
      throw RequestError(
          fmt::format("seed {} has {} numbers instead of {}", number, state.size(), wanted));
    const double distance = level.distance_from_level(state.data());
    if (!(distance <= kSeedOnLevel))
      throw RequestError(
          fmt::format("seed {} is not on the level {}, but off by {:.2g} of the size of its terms",
                      number, level.problem().level_text(), distance));
    seeds.emplace_back(
        Eigen::Map<const LevelSet::Vector>(state.data(), static_cast<Eigen::Index>(wanted)));
  }
  return seeds;
}

}  // namespace

PoincareSection section(const Model& model, const Scene& scene, const PoincareOptions& options) {
  PoincareSection result{
      std::make_unique<const SectionProblem>(section_problem(model, scene, options.request)), {}};
  if (options.longest_cycle > 0) require_derivative_of_return(*result.problem);
  const LevelSet level(*result.problem);
  const OrbitCutter cutter(*result.problem, {options.tolerance, options.jobs, options.give_up},
                           options.orbits * options.points);
  const std::vector<LevelSet::Vector> seeds = checked_seeds(level, options.seeds);
  std::vector<PlacedPoint> domain;
  if (seeds.empty() || options.longest_cycle > 0) domain = domain_of_motion(level, cutter);
  result.orbits =
      seeds.empty()
          ? domain_orbits(level, cutter, domain, options.orbits, options.points, options.progress)
          : judged_orbits(level, cutter.orbits(seeds, options.points, options.progress), seeds);
  if (options.rotation)
    for (const OrbitReport& orbit : result.orbits)
      result.rotations.push_back(rotation_of_orbit(*result.problem, orbit));
  if (options.longest_cycle == 0) return result;
  result.cycles = find_cycles(
      level, cutter, cycle_starts(level, domain, result.orbits, options.longest_cycle),
      options.longest_cycle, verdict_on_jacobi(model, scene) == Verdict::proved, [](double) {});
  if (options.prove_cycles)
    result.proofs = enclose_cycles(model, scene, *result.problem, result.cycles.cycles);
  return result;
}

}  // namespace casimir
