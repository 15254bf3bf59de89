#include "tools/analysis/sweep/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "codegen/emit_cpp.hpp"
#include "tools/analysis/proof/exact_text.hpp"
#include "tools/analysis/section/domain_orbits.hpp"

namespace casimir {
namespace {

constexpr double kNoIndicator = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Sections::Sections(const Model& model, const Scene& scene, const GridPoints& places,
                   SectionRequest request, std::size_t orbits, std::size_t points, double tolerance)
    : model_(model),
      scene_(scene),
      places_(places),
      request_(std::move(request)),
      orbits_(orbits),
      points_(points),
      tolerance_(tolerance) {
  const SectionProblem problem = section_problem(model, scene, request_);
  text_ = fmt::format("{} {} {} {}\n", problem.plane_text, problem.plane.upwards,
                      problem.plotted[0].text, problem.plotted[1].text) +
          emit_module(problem.run.specialisation);
  for (const double x : problem.run.initial) text_ += exact_text(x) + " ";
  for (std::size_t i = 0; i < problem.levels.size(); ++i)
    text_ += problem.level_names[i] + " " + exact_text(problem.levels[i]) + "\n";
}

std::vector<std::string> Sections::columns() const {
  return {"orbits", "crossings", "regular", "chaotic", "exponent", "off_level"};
}

std::string Sections::fingerprint() const {
  return fmt::format("sections {} orbits {} points {} tolerance {}\n", CASIMIR_VERSION, orbits_,
                     points_, exact_text(tolerance_)) +
         text_;
}

PointResult Sections::cut(std::size_t point, int threads,
                          const std::function<bool()>& give_up) const {
  const Scene scene = places_.scene_at(point, model_, scene_);
  const SectionProblem problem = section_problem(model_, scene, request_);
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {tolerance_, threads, give_up}, orbits_ * points_);
  const std::vector<OrbitReport> orbits =
      domain_orbits(level, cutter, domain_of_motion(level, cutter), orbits_, points_);
  if (cutter.interrupted())
    return {Status::stopped, std::vector<double>(columns().size(), kNoIndicator)};
  const double none = problem.jumps ? kNoIndicator : 0;
  double crossings = 0, regular = none, chaotic = none, exponent = kNoIndicator, off = 0;
  Status status = Status::ok;
  for (const OrbitReport& orbit : orbits) {
    crossings += static_cast<double>(orbit.places.size());
    if (orbit.leaves_level) status = Status::drift_exceeded;
    if (orbit.orbit.returns && orbit.orbit.status != Status::ok) status = orbit.orbit.status;
    off = std::max(off, orbit.off_level);
    if (!orbit.judged) continue;
    (orbit.chaotic ? chaotic : regular) += 1;
    exponent = std::fmax(exponent, orbit.exponent);
  }
  return {status, {static_cast<double>(orbits.size()), crossings, regular, chaotic, exponent, off}};
}

std::vector<PointResult> Sections::run(const std::vector<std::size_t>& points, int threads,
                                       const std::function<bool()>& give_up) const {
  std::vector<PointResult> results(
      points.size(), {Status::stopped, std::vector<double>(columns().size(), kNoIndicator)});
  // The orbits of one section are what the threads share.
  for (std::size_t k = 0; k < points.size() && !(give_up && give_up()); ++k)
    results[k] = cut(points[k], threads, give_up);
  return results;
}

}  // namespace casimir
