#include "tools/analysis/section/domain_orbits.hpp"

namespace casimir {

std::vector<PlacedPoint> domain_of_motion(const LevelSet& level, const OrbitCutter& cutter) {
  const SectionProblem& problem = level.problem();
  std::vector<LevelSet::Vector> known;
  if (problem.on_scene)
    known.emplace_back(Eigen::Map<const LevelSet::Vector>(
        problem.run.initial.data(), static_cast<Eigen::Index>(problem.states())));
  return points_of_domain(level, cutter.returning(), known);
}

std::vector<OrbitReport> domain_orbits(const LevelSet& level, const OrbitCutter& cutter,
                                       const std::vector<PlacedPoint>& domain, std::size_t orbits,
                                       std::size_t points,
                                       const std::function<void(double)>& progress) {
  if (domain.empty()) return {};
  std::vector<LevelSet::Vector> seeds;
  for (const PlacedPoint& point : centred(level, domain, spread_out(level, domain, orbits)))
    seeds.push_back(point.x);
  return judged_orbits(level, cutter.orbits(seeds, points, progress), seeds);
}

}  // namespace casimir
