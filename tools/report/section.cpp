// The Poincare section of a report: some orbits all over the domain of possible motion, on the
// level of the scene.
#include "tools/analysis/section/domain_orbits.hpp"
#include "tools/plot/plot.hpp"
#include "tools/report/pictures.hpp"
#include "tools/section/picture.hpp"
#include "tools/section/request.hpp"

namespace casimir::tools {

std::string section_svg(const CaseFile& file, const Model& model, const Scene& scene,
                        const std::string& beside) {
  constexpr std::size_t kOrbits = 24, kPoints = 200;
  constexpr double kTolerance = 1e-14, kLongest = 5;
  const SectionProblem problem = section_problem(model, scene, section_request(file, model));
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {kTolerance, 0, time_limit(kLongest)}, kOrbits * kPoints);
  const std::vector<OrbitReport> orbits = domain_orbits(level, cutter, kOrbits, kPoints);
  if (orbits.empty()) return {};
  return page_svg(
      [&](const std::string& output) {
        return section_script(problem.plotted, "", orbits, {}, {},
                              "svg size 640,520 dynamic background rgb 'white' font 'sans,15'",
                              output);
      },
      "section", beside);
}

}  // namespace casimir::tools
