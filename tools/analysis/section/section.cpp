#include "tools/analysis/section/section.hpp"

#include "tools/analysis/section/domain_orbits.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"

namespace casimir {

std::size_t PoincareSection::crossings() const {
  std::size_t sum = 0;
  for (const OrbitReport& orbit : orbits) sum += orbit.places.size();
  return sum;
}

PoincareSection section(const Model& model, const Scene& scene, const PoincareOptions& options) {
  PoincareSection result{
      std::make_unique<const SectionProblem>(section_problem(model, scene, options.request)), {}};
  const LevelSet level(*result.problem);
  const OrbitCutter cutter(*result.problem, {options.tolerance, options.jobs, options.give_up},
                           options.orbits * options.points);
  const std::vector<PlacedPoint> domain = domain_of_motion(level, cutter);
  result.orbits =
      domain_orbits(level, cutter, domain, options.orbits, options.points, options.progress);
  if (options.rotation)
    for (const OrbitReport& orbit : result.orbits)
      result.rotations.push_back(rotation_of_orbit(*result.problem, orbit));
  if (options.longest_cycle == 0) return result;
  result.cycles =
      find_cycles(level, cutter, cycle_starts(level, domain, result.orbits, options.longest_cycle),
                  options.longest_cycle, [](double) {});
  if (options.prove_cycles)
    result.proofs = enclose_cycles(model, scene, *result.problem, result.cycles.cycles);
  return result;
}

}  // namespace casimir
