// The Poincare section of a report: some orbits all over the domain of possible motion, on the
// level of the scene.
#include "tools/plot.hpp"
#include "tools/report/pictures.hpp"
#include "tools/section/picture.hpp"
#include "tools/section/spread.hpp"

namespace casimir::tools {

std::string section_svg(const CaseFile& file, const Model& model, const Scene& scene,
                        const std::string& beside) {
  constexpr std::size_t kOrbits = 24, kPoints = 200;
  constexpr double kTolerance = 1e-14, kLongest = 5;
  const SectionProblem problem = section_problem(file, model, scene, {});
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {kTolerance, 0, time_limit(kLongest)}, kOrbits * kPoints);
  std::vector<LevelSet::Vector> known;
  if (problem.on_scene)
    known.emplace_back(Eigen::Map<const LevelSet::Vector>(
        problem.run.initial.data(), static_cast<Eigen::Index>(problem.states())));
  const std::vector<PlacedPoint> domain = points_of_domain(level, cutter.returning(), known);
  if (domain.empty()) return {};
  std::vector<LevelSet::Vector> seeds;
  for (const PlacedPoint& point : centred(level, domain, spread_out(level, domain, kOrbits)))
    seeds.push_back(point.x);
  const std::vector<OrbitReport> orbits =
      judged_orbits(level, cutter.orbits(seeds, kPoints), seeds);
  return page_svg(
      [&](const std::string& output) {
        return section_script(problem, "", orbits, {},
                              "svg size 640,520 dynamic background rgb 'white' font 'sans,15'",
                              output);
      },
      "section", beside);
}

}  // namespace casimir::tools
