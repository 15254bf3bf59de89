#include "tools/analysis/section/cycles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

using Vector = LevelSet::Vector;
using Matrix = Eigen::MatrixXd;

constexpr int kRoundsOfCycle = 25;
/// Newton's method has arrived where a return is so near, relative to the size of the state.
constexpr double kReturnsWithin = 1e-9, kSameCycle = 1e-6;
constexpr double kAreaKept = 1e-4;

/// A point on its way to a cycle.
struct Attempt {
  Vector x;
  Matrix basis;  ///< of the tangent plane there
  Cycle cycle;   ///< what is known of the last round
  Vector miss;   ///< from x to where it returns
  Matrix derivative;
  bool failed = false, arrived = false;
};

class Newton {
 public:
  Newton(const LevelSet& level, const OrbitCutter& cutter, std::size_t length)
      : level_(level), cutter_(cutter), length_(length) {}

  void run(std::vector<Attempt>& attempts, const std::function<void(double)>& progress) {
    for (int round = 0; round < kRoundsOfCycle && !cutter_.interrupted(); ++round) {
      progress(static_cast<double>(round) / kRoundsOfCycle);
      std::vector<Attempt*> active;
      for (Attempt& attempt : attempts)
        if (!attempt.failed && !attempt.arrived) active.push_back(&attempt);
      if (active.empty()) return;
      return_all(active);
      for (Attempt* attempt : active)
        if (!attempt->failed) advance(*attempt);
    }
  }

 private:
  /// Two orbits for each attempt, with one tangent deviation each.
  void return_all(const std::vector<Attempt*>& attempts) {
    std::vector<Vector> seeds, deviations;
    for (Attempt* attempt : attempts) {
      attempt->basis = level_.tangent(attempt->x);
      for (int k = 0; k < 2; ++k) {
        seeds.push_back(attempt->x);
        deviations.push_back(attempt->basis.col(k));
      }
    }
    const SectionResult result = cutter_.with_deviations(seeds, deviations, length_);
    for (std::size_t i = 0; i < attempts.size(); ++i)
      take(*attempts[i], result.orbits[2 * i], result.orbits[2 * i + 1]);
  }

  void take(Attempt& attempt, const SectionOrbit& first, const SectionOrbit& second) {
    attempt.failed = first.size() != length_ || second.size() != length_;
    if (attempt.failed) return;
    const auto n = static_cast<Eigen::Index>(level_.problem().states());
    attempt.cycle.points.clear();
    for (std::size_t k = 0; k < length_; ++k) {
      const Vector x =
          Eigen::Map<const Vector>(first.states.data() + 2 * static_cast<std::ptrdiff_t>(k) * n, n);
      attempt.cycle.points.push_back({x, level_.plotted(x.data())});
    }
    const Vector& end = attempt.cycle.points.back().x;
    attempt.miss = level_.difference(end, attempt.x);
    const Vector field = level_.field(end), normal = level_.plane_gradient(end);
    attempt.derivative = Matrix(2, 2);
    for (int k = 0; k < 2; ++k) {
      const SectionOrbit& orbit = k == 0 ? first : second;
      Vector moved = Eigen::Map<const Vector>(
          orbit.states.data() + (2 * static_cast<std::ptrdiff_t>(length_) - 1) * n, n);
      // Back to the plane, along the orbit.
      moved -= field * (normal.dot(moved) / normal.dot(field));
      attempt.derivative.col(k) = attempt.basis.transpose() * moved;
    }
    attempt.cycle.period = first.times.back();
    attempt.cycle.trace = attempt.derivative.trace();
    const Matrix& d = attempt.derivative;
    attempt.cycle.determinant = d(0, 0) * d(1, 1) - d(0, 1) * d(1, 0);
    attempt.cycle.residual = attempt.miss.norm();
    attempt.failed = !std::isfinite(attempt.cycle.trace + attempt.cycle.residual);
  }

  void advance(Attempt& attempt) {
    const double size = attempt.x.norm();
    const Matrix equations = attempt.derivative - Matrix::Identity(2, 2);
    Vector step = -shortest_solution(equations, attempt.basis.transpose() * attempt.miss, 1e-15);
    if (!step.allFinite()) {
      attempt.failed = true;
      return;
    }
    // Nothing is gained any more, and where it is the return is near.
    if (step.norm() < 1e-11 * size) {
      attempt.arrived = attempt.miss.norm() < kReturnsWithin * size;
      attempt.failed = !attempt.arrived;
      return;
    }
    const double longest = 0.1 * size;
    if (step.norm() > longest) step *= longest / step.norm();
    attempt.x += attempt.basis * step;
    if (!level_.project(attempt.x) || level_.speed(attempt.x) <= 0) attempt.failed = true;
  }

  const LevelSet& level_;
  const OrbitCutter& cutter_;
  const std::size_t length_;
};

bool same_point(const LevelSet& level, const Vector& a, const Vector& b) {
  return level.difference(a, b).norm() < kSameCycle * (1 + a.norm());
}

/// Whether it is run through several times.
bool repeats(const LevelSet& level, const Cycle& cycle) {
  for (std::size_t k = 0; k + 1 < cycle.length(); ++k)
    if (same_point(level, cycle.points[k].x, cycle.points.back().x)) return true;
  return false;
}

bool is_known(const LevelSet& level, const Cycle& cycle, const std::vector<Cycle>& known) {
  return std::ranges::any_of(known, [&](const Cycle& other) {
    return other.length() == cycle.length() &&
           std::ranges::any_of(other.points, [&](const PlacedPoint& point) {
             return same_point(level, point.x, cycle.points.front().x);
           });
  });
}

/// An angle next to its period is next to 0.
void turn_back(const LevelSet& level, Cycle& cycle) {
  for (PlacedPoint& point : cycle.points)
    for (std::size_t k = 0; k < 2; ++k) {
      const double period = level.problem().plotted[k].period;
      if (period > 0 && point.place[k] > period * (1 - 1e-9)) point.place[k] -= period;
    }
}

/// Begins where the first plotted function is least, so that a cycle is told in one way.
void turn(Cycle& cycle) {
  const auto first = std::ranges::min_element(cycle.points, {}, &PlacedPoint::place);
  std::rotate(cycle.points.begin(), first, cycle.points.end());
}

}  // namespace

std::string Cycle::kind() const {
  if (!keeps_area) {
    switch (stability()) {
      case SpectralStability::stable:
        return "attracting";
      case SpectralStability::unstable:
        return "unstable";
      default:
        return "near the unit circle";
    }
  }
  switch (stability()) {
    case SpectralStability::stable:
      return "elliptic";
    case SpectralStability::unstable:
      return trace > 0 ? "hyperbolic" : "inverse hyperbolic";
    default:
      return "parabolic or nearly so";
  }
}

SpectralStability Cycle::stability() const {
  // What integration leaves of a derivative, and what it has made of the determinant.
  constexpr double kError = 1e-7, kOfDeterminant = 10;
  if (!keeps_area) {
    const double growth = std::max(std::abs(multipliers()[0]), std::abs(multipliers()[1])) - 1;
    // Two that are near each other are moved by the root of an error.
    if (!(std::abs(growth) > std::sqrt(kError))) return SpectralStability::undecided;
    return growth < 0 ? SpectralStability::stable : SpectralStability::unstable;
  }
  const double error = kError + kOfDeterminant * std::abs(determinant - 1);
  const double beyond = std::abs(trace) - 2;
  if (!(std::abs(beyond) > error)) return SpectralStability::undecided;
  return beyond < 0 ? SpectralStability::stable : SpectralStability::unstable;
}

std::array<std::complex<double>, 2> Cycle::multipliers() const {
  const double product = keeps_area ? 1 : determinant;
  const std::complex<double> half = trace / 2;
  const std::complex<double> root = std::sqrt(half * half - product);
  // The larger one without cancellation, the other by their product.
  const std::complex<double> first = trace < 0 ? half - root : half + root;
  return {first, product / first};
}

std::vector<PlacedPoint> cycle_starts(const LevelSet& level, const std::vector<PlacedPoint>& domain,
                                      const std::vector<OrbitReport>& orbits, std::size_t longest) {
  constexpr std::size_t kSpread = 400;
  std::vector<PlacedPoint> result = spread_out(level, domain, kSpread);
  const auto n = static_cast<Eigen::Index>(level.problem().states());
  for (const OrbitReport& orbit : orbits) {
    const auto at = [&](std::size_t k) -> LevelSet::Vector {
      return Eigen::Map<const LevelSet::Vector>(
          orbit.orbit.states.data() + static_cast<Eigen::Index>(k) * n, n);
    };
    for (std::size_t length = 1; length <= longest; ++length) {
      double nearest = std::numeric_limits<double>::infinity();
      std::optional<PlacedPoint> best;
      for (std::size_t i = 0; i + length < orbit.places.size(); ++i) {
        const double d = level.difference(at(i), at(i + length)).norm();
        if (d < nearest) best = {at(i), orbit.places[i]};
        nearest = std::min(nearest, d);
      }
      if (best) result.push_back(*best);
    }
  }
  return result;
}

CycleSearch find_cycles(const LevelSet& level, const OrbitCutter& cutter,
                        const std::vector<PlacedPoint>& starts, std::size_t longest,
                        bool keeps_area, const std::function<void(double)>& progress) {
  CycleSearch result;
  for (std::size_t length = 1; length <= longest; ++length) {
    std::vector<Attempt> attempts(starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) attempts[i].x = starts[i].x;
    Newton(level, cutter, length).run(attempts, [&](double share) {
      progress((static_cast<double>(length - 1) + share) / static_cast<double>(longest));
    });
    std::vector<Cycle> found;
    for (Attempt& attempt : attempts) {
      Cycle& cycle = attempt.cycle;
      if (!attempt.arrived || repeats(level, cycle)) continue;
      cycle.keeps_area = keeps_area;
      const double product = cycle.keeps_area ? 1 : cycle.determinant;
      if (std::abs(1 - cycle.trace + product) < kDegenerateCycle) {
        ++result.degenerate;
        continue;
      }
      if (cycle.keeps_area && std::abs(cycle.determinant - 1) > kAreaKept) continue;
      if (is_known(level, cycle, found)) continue;
      turn_back(level, cycle);
      turn(cycle);
      found.push_back(std::move(cycle));
    }
    std::ranges::sort(found, {}, [](const Cycle& cycle) { return cycle.points.front().place; });
    for (Cycle& cycle : found) result.cycles.push_back(std::move(cycle));
  }
  return result;
}

}  // namespace casimir
