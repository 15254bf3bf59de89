// The Poincare section of a report: some orbits all over the domain of possible motion, on the
// level of the scene.
#include <fmt/format.h>

#include <algorithm>

#include "tools/analysis/section/domain_orbits.hpp"
#include "tools/cli/errors.hpp"
#include "tools/report/charts.hpp"
#include "tools/report/pictures.hpp"
#include "tools/section/request.hpp"

namespace casimir::tools {
namespace {

/// What is grey in the picture of these orbits.
std::string words_on_grey(const std::vector<OrbitReport>& orbits) {
  const auto unknown = std::ranges::count(orbits, false, &OrbitReport::judged);
  const bool chaotic = std::ranges::any_of(
      orbits, [](const OrbitReport& orbit) { return orbit.judged && orbit.chaotic; });
  std::string words;
  if (chaotic) words += " Chaotic orbits are grey.";
  if (unknown > 0)
    words += fmt::format(
        " Of {}, too short, running away or of equations that jump, it is not known: {} grey.",
        unknown == 1 ? "one orbit" : fmt::format("{} orbits", unknown),
        chaotic ? "these, too, are" : "these are");
  return words;
}

}  // namespace

void cut_section(const CaseFile& file, const Model& model, const Scene& scene, Pictures& pictures) {
  constexpr std::size_t kOrbits = 24, kPoints = 200;
  constexpr double kTolerance = 1e-14, kLongest = 5;
  const SectionProblem problem = section_problem(model, scene, section_request(file, model));
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {kTolerance, 0, time_limit(kLongest)}, kOrbits * kPoints);
  const std::vector<OrbitReport> orbits =
      domain_orbits(level, cutter, domain_of_motion(level, cutter), kOrbits, kPoints);
  if (orbits.empty()) return;
  const Chart chart = section_chart(problem.plotted, orbits);
  pictures.section_caption = fmt::format(
      "{} orbits on the level {}, cut where the function of the section is zero and {}; each step "
      "to "
      "{:g}.{}",
      orbits.size(), problem.level_text(), problem.plane.upwards ? "grows" : "falls", kTolerance,
      words_on_grey(orbits));
  pictures.section = chart_svg(chart);
  pictures.thumbnail = thumbnail_svg(chart);
  DrawnSection drawn{problem.plotted,
                     problem.plane.upwards,
                     problem.plane.period > 0,
                     problem.level_names,
                     {},
                     {}};
  if (!problem.on_scene) drawn.levels = problem.levels;
  for (const OrbitReport& orbit : orbits)
    drawn.seeds.emplace_back(orbit.seed.begin(), orbit.seed.end());
  pictures.drawn_section = std::move(drawn);
}

}  // namespace casimir::tools
