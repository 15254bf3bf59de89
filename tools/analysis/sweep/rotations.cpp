#include "tools/analysis/sweep/rotations.hpp"

#include <fmt/format.h>

#include <limits>

#include "codegen/emit_cpp.hpp"
#include "tools/analysis/proof/exact_text.hpp"
#include "tools/analysis/section/orbit_rotation.hpp"

namespace casimir {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

double number_of_kind(Rotation::Kind kind) {
  switch (kind) {
    case Rotation::Kind::curve:
      return 1;
    case Rotation::Kind::islands:
      return 2;
    case Rotation::Kind::cycle:
      return 3;
    case Rotation::Kind::none:
      break;
  }
  return 0;
}

}  // namespace

Rotations::Rotations(const Model& model, const Scene& scene, const GridPoints& places,
                     SectionRequest request, std::size_t points, double tolerance)
    : model_(model),
      scene_(scene),
      places_(places),
      request_(std::move(request)),
      points_(points),
      tolerance_(tolerance) {
  const SectionProblem problem = section_problem(model, scene, request_);
  text_ = fmt::format("{} {} {} {}\n", problem.plane_text, problem.plane.upwards,
                      problem.plotted[0].text, problem.plotted[1].text) +
          emit_module(problem.run.specialisation);
  for (const double x : problem.run.initial) text_ += exact_text(x) + " ";
}

std::vector<std::string> Rotations::columns() const {
  return {"kind",  "rotation",    "rotation_error", "parts",
          "inner", "inner_error", "crossings",      "megno"};
}

std::string Rotations::fingerprint() const {
  return fmt::format("rotations {} points {} tolerance {}\n", CASIMIR_VERSION, points_,
                     exact_text(tolerance_)) +
         text_;
}

PointResult Rotations::turn(std::size_t point, const std::function<bool()>& give_up) const {
  const Scene scene = places_.scene_at(point, model_, scene_);
  // The level is that of the point: an energy that the section names would be another one.
  SectionRequest request = request_;
  request.energy.reset();
  request.casimirs.clear();
  const SectionProblem problem = section_problem(model_, scene, request);
  const LevelSet level(problem);
  const OrbitCutter cutter(problem, {tolerance_, 1, give_up}, points_);
  const LevelSet::Vector start = Eigen::Map<const LevelSet::Vector>(
      problem.run.initial.data(), static_cast<Eigen::Index>(problem.states()));
  std::vector<OrbitReport> orbits = judged_orbits(level, cutter.orbits({start}, points_), {start});
  const OrbitReport& orbit = orbits.front();
  std::vector<double> values(columns().size(), kNotKnown);
  values[6] = static_cast<double>(orbit.places.size());
  if (cutter.interrupted()) return {Status::stopped, values};
  if (orbit.leaves_level) return {Status::drift_exceeded, values};
  if (orbit.orbit.returns && orbit.orbit.status != Status::ok) return {orbit.orbit.status, values};
  const Rotation rotation = rotation_of_orbit(problem, orbit);
  values[0] = number_of_kind(rotation.kind);
  if (orbit.judged) values[7] = orbit.megno;
  if (rotation.kind == Rotation::Kind::none) return {Status::ok, values};
  values[1] = rotation.number;
  values[2] = rotation.error;
  values[3] = static_cast<double>(rotation.parts);
  if (rotation.kind == Rotation::Kind::islands) {
    values[4] = rotation.inner_number;
    values[5] = rotation.inner_error;
  }
  return {Status::ok, values};
}

std::vector<PointResult> Rotations::run(const std::vector<std::size_t>& points, int /*threads*/,
                                        const std::function<bool()>& give_up) const {
  std::vector<PointResult> results(
      points.size(), {Status::stopped, std::vector<double>(columns().size(), kNotKnown)});
  // Problems are made of exact numbers, which are counted without locks: one after the other.
  for (std::size_t k = 0; k < points.size() && !(give_up && give_up()); ++k)
    results[k] = turn(points[k], give_up);
  return results;
}

}  // namespace casimir
