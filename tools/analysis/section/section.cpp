#include "tools/analysis/section/section.hpp"

#include "tools/analysis/section/domain_orbits.hpp"

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
  result.orbits = domain_orbits(level, cutter, options.orbits, options.points, options.progress);
  return result;
}

}  // namespace casimir
