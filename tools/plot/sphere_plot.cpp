// Curves on a sphere, seen from a point a little above its equator and far away.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "symbolic/vector_form.hpp"
#include "tools/analysis/quantities.hpp"
#include "tools/cli/errors.hpp"
#include "tools/plot/motion_plot.hpp"

namespace casimir::tools {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

/// A vector keeps its length if it does to this, relative to it.
constexpr double kSameLength = 1e-6;

struct Seen {
  double x, y;
  bool in_front;
};

Seen seen(const Vector3d& v) {
  constexpr double kAround = 30 * std::numbers::pi / 180, kAbove = 22 * std::numbers::pi / 180;
  const Vector3d towards(std::cos(kAbove) * std::cos(kAround), std::cos(kAbove) * std::sin(kAround),
                         std::sin(kAbove));
  const Vector3d right(-std::sin(kAround), std::cos(kAround), 0);
  return {v.dot(right), v.dot(towards.cross(right)), v.dot(towards) >= 0};
}

/// Its points with a gap wherever it is on the other side.
Curve side_of(const Path& path, bool in_front, Curve::Style style, const std::string& name) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  Curve curve{name, {}, style};
  for (const Vector3d& v : path) {
    const Seen point = seen(v);
    if (point.in_front == in_front)
      curve.points.emplace_back(point.x, point.y);
    else if (!curve.points.empty() && std::isfinite(curve.points.back().first))
      curve.points.emplace_back(kGap, kGap);
  }
  return curve;
}

Path circle(const Vector3d& centre, const Vector3d& a, const Vector3d& b) {
  constexpr int kPoints = 120;
  Path path;
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints;
    path.push_back(centre + std::cos(angle) * a + std::sin(angle) * b);
  }
  return path;
}

/// The outline, three parallels and the meridians every 45 degrees; only their front halves.
void add_globe(Plot& plot) {
  Curve outline{"", {}, Curve::Style::guide};
  for (const Vector3d& v : circle(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()))
    outline.points.emplace_back(v.x(), v.y());
  plot.curves.push_back(outline);
  const Vector3d z = Vector3d::UnitZ();
  for (const double height : {-0.5, 0.0, 0.5}) {
    const double radius = std::sqrt(1 - height * height);
    plot.curves.push_back(
        side_of(circle(height * z, radius * Vector3d::UnitX(), radius * Vector3d::UnitY()), true,
                Curve::Style::guide, ""));
  }
  for (int i = 0; i < 4; ++i) {
    const double angle = i * std::numbers::pi / 4;
    plot.curves.push_back(
        side_of(circle(Vector3d::Zero(), Vector3d(std::cos(angle), std::sin(angle), 0), z), true,
                Curve::Style::guide, ""));
  }
}

Plot globe(const std::string& title, const std::string& label, const Path& path) {
  Plot plot{.title = title, .square = true};
  add_globe(plot);
  plot.curves.push_back(side_of(path, false, Curve::Style::faint, ""));
  plot.curves.push_back(side_of(path, true, Curve::Style::path, label));
  const Seen first = seen(path.front());
  plot.curves.push_back({"start",
                         {{first.x, first.y}},
                         first.in_front ? Curve::Style::mark : Curve::Style::far_mark});
  return plot;
}

Path path_of(const Motion& motion, const Triple& triple) {
  Path path;
  for (const std::vector<double>& x : motion.states)
    path.emplace_back(x[triple.indices[0]], x[triple.indices[1]], x[triple.indices[2]]);
  return path;
}

bool keeps_length(const Path& path) {
  const double length = path.front().norm();
  return length > 0 && std::ranges::all_of(path, [&](const Vector3d& v) {
           return std::abs(v.norm() - length) <= kSameLength * length;
         });
}

std::string names_of(const std::vector<Triple>& triples) {
  std::vector<std::string> names;
  for (const Triple& triple : triples) names.push_back(triple.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// M of a vector that dv/dt = c v x dH/dM turns, with c = 1 or -1; none for any other.
struct Turned {
  std::size_t vector, momentum;  ///< blocks
  int sign;
};

std::optional<Turned> turned_by(const VectorForm& form, std::size_t target) {
  const auto& flow = form.flows[target];
  if (!form.blocks[target].is_vector() || flow.size() != 1 || flow[0].left != target ||
      flow[0].gradient == target || !form.blocks[flow[0].gradient].is_vector())
    return std::nullopt;
  const GiNaC::ex& c = flow[0].coefficient;
  if (!c.is_equal(1) && !c.is_equal(-1)) return std::nullopt;
  return Turned{target, flow[0].gradient, c.is_equal(1) ? 1 : -1};
}

/// The form of the bracket, if the model has one that gives its equations.
std::optional<VectorForm> form_of(const Model& model) {
  if (!model.poisson || !model.hamiltonian) return std::nullopt;
  std::optional<VectorForm> form = find_vector_form(*model.poisson);
  if (form && !reproduces(*form, model.variables, *model.hamiltonian, model.field)) form.reset();
  return form;
}

std::vector<Turned> turned_vectors(const std::optional<VectorForm>& form) {
  std::vector<Turned> result;
  for (std::size_t i = 0; form && i < form->blocks.size(); ++i)
    if (const auto turned = turned_by(*form, i)) result.push_back(*turned);
  return result;
}

/// The rotation by which the body turns in a time h, from its angular velocities (in the body) at
/// the beginning, the middle and the end: the exponential of the first terms of Magnus' series, of
/// order 4.
Eigen::Matrix3d turn(double h, const Vector3d& a, const Vector3d& middle, const Vector3d& b) {
  const Vector3d angle = h / 6 * (a + 4 * middle + b) + h * h / 12 * a.cross(b);
  const double size = angle.norm();
  if (size == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(size, angle / size).toRotationMatrix();
}

/// A rotation that takes a vector to the direction of (0, 0, 1).
Eigen::Matrix3d upright(const Vector3d& vector) {
  const Vector3d axis = vector.cross(Vector3d::UnitZ());
  const double size = axis.norm();
  if (size == 0) return Vector3d(1, vector.z() < 0 ? -1 : 1, vector.z() < 0 ? -1 : 1).asDiagonal();
  return Eigen::AngleAxisd(std::atan2(size, vector.z()), axis / size).toRotationMatrix();
}

/// The third axis of the body in space, where `vertical` is (0, 0, 1).
Path apex(const Motion& motion, const Path& vertical, const Path& velocity) {
  Eigen::Matrix3d attitude = upright(vertical.front());
  Path path{attitude.col(2)};
  for (std::size_t k = 0; k + 2 < velocity.size(); k += 2) {
    attitude *=
        turn(motion.times[k + 2] - motion.times[k], velocity[k], velocity[k + 1], velocity[k + 2]);
    path.emplace_back(attitude.col(2));
  }
  return path;
}

}  // namespace

Plot sphere_picture(const Model& model, const Scene& scene, const Motion& motion,
                    const std::string& name) {
  const std::vector<Triple> triples = find_triples(motion.names);
  if (triples.empty())
    throw UsageError("--plot-sphere needs a vector, three states such as g1, g2, g3");
  for (const Triple& triple : triples) {
    if (!name.empty() && triple.name != name) continue;
    Path path = path_of(motion, triple);
    if (!keeps_length(path)) {
      if (name.empty()) continue;
      throw UsageError(fmt::format("--plot-sphere={}: the length of {} changes", name, name));
    }
    for (Vector3d& v : path) v.normalize();
    return globe(picture_title(model, scene), fmt::format("{0}/|{0}|, behind: dotted", triple.name),
                 path);
  }
  if (name.empty())
    throw UsageError(
        fmt::format("--plot-sphere: the lengths of all vectors ({}) change", names_of(triples)));
  throw UsageError(fmt::format("--plot-sphere={}: there is no such vector; there are {}",
                               printable(name), names_of(triples)));
}

Plot apex_picture(const Model& model, const Scene& scene, const Motion& motion,
                  const std::string& name) {
  const auto form = form_of(model);
  const std::vector<Turned> all = turned_vectors(form);
  std::string known;
  for (const Turned& turned : all) {
    const std::string& vector = form->blocks[turned.vector].name;
    known += (known.empty() ? "" : ", ") + vector;
    if (!name.empty() && vector != name) continue;
    std::vector<GiNaC::ex> functions;
    for (const std::size_t c : form->blocks[turned.vector].coordinates)
      functions.emplace_back(model.variables[c]);
    for (const std::size_t c : form->blocks[turned.momentum].coordinates)
      functions.push_back(turned.sign * model.hamiltonian->diff(model.variables[c]));
    const Quantities quantities(model, scene, functions, motion.names);
    Path vertical, velocity;
    for (std::size_t k = 0; k < motion.times.size(); ++k) {
      const std::vector<double> v = quantities(motion.times[k], motion.states[k]);
      vertical.emplace_back(v[0], v[1], v[2]);
      velocity.emplace_back(v[3], v[4], v[5]);
    }
    if (vertical.front().norm() == 0)
      throw UsageError(fmt::format("--plot-apex: {} is zero", vector));
    return globe(picture_title(model, scene), "apex, behind: dotted",
                 apex(motion, vertical, velocity));
  }
  if (all.empty())
    throw UsageError(
        "--plot-apex needs a vector that is fixed in space, dg/dt = g x dH/dM; see casimir show");
  throw UsageError(
      fmt::format("--plot-apex={}: there is no such vector fixed in space; there are {}",
                  printable(name), known));
}

bool has_sphere(const Motion& motion) {
  return std::ranges::any_of(find_triples(motion.names), [&](const Triple& triple) {
    return keeps_length(path_of(motion, triple));
  });
}

bool has_apex(const Model& model, const Motion& motion) {
  return motion.names.size() == model.variables.size() && !turned_vectors(form_of(model)).empty();
}

}  // namespace casimir::tools
