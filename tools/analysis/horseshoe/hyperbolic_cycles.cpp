#include "tools/analysis/horseshoe/hyperbolic_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "runtime/step/dense.hpp"

namespace casimir::horseshoe {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int kRoundsOfFixedPoint = 14;
constexpr std::size_t kOrbitPoints = 400, kRandomStarts = 240, kStartsOfALength = 160;
constexpr double kSameOrbit = 1e-7;
/// What grows less at a return makes no horseshoe that could be proved.
constexpr double kLeastGrowth = 1.6;

/// Some returns of a state, and the derivative of all of them along the tangent planes.
struct IteratedReturn {
  std::vector<Returned> returns;
  std::vector<Matrix> bases;        ///< of the tangent planes, that of the start first
  std::vector<Matrix> derivatives;  ///< 2 x 2, of each return
};

std::optional<IteratedReturn> iterated(const NumericReturn& map, Vector x, std::size_t length) {
  IteratedReturn result;
  result.bases.push_back(map.tangent(x));
  for (std::size_t k = 0; k < length; ++k) {
    auto next = map(x, true);
    if (!next || !next->derivative.allFinite()) return std::nullopt;
    x = next->state;
    result.bases.push_back(k + 1 == length ? result.bases.front() : map.tangent(x));
    result.derivatives.push_back(between(result.bases[k + 1], next->derivative, result.bases[k]));
    result.returns.push_back(std::move(*next));
  }
  return result;
}

class CycleFinder {
 public:
  CycleFinder(const SectionSystem& system, const NumericReturn& map, std::size_t longest,
              const std::function<bool()>& give_up)
      : system_(system), map_(map), longest_(longest), give_up_(give_up) {}

  std::vector<HyperbolicCycle> run() {
    collect_starts();
    for (std::size_t length = 1; length <= longest_; ++length)
      for (const Vector& start : starts_of(length)) {
        if (give_up_ && give_up_()) break;
        if (const auto found = newton(start, length)) keep(*found);
      }
    std::ranges::stable_sort(found_, std::greater{}, &HyperbolicCycle::growth);
    return std::move(found_);
  }

 private:
  /// The orbit of the scene, without its beginning, and of points near it.
  void collect_starts() {
    Vector x = system_.start;
    if (const auto first = map_(x, false)) x = first->state;
    if (!map_.project(x)) x = system_.start;
    const double size = 0.2 + x.norm();
    follow(x, kOrbitPoints);
    std::mt19937 random(20240607);
    std::normal_distribution<double> normal;
    constexpr int kFollowed = 8;
    for (std::size_t k = 0; k < kRandomStarts && !(give_up_ && give_up_()); ++k) {
      Vector y = system_.start;
      const double reach = size * (0.1 + 0.9 * static_cast<double>(k) / kRandomStarts);
      for (double& one : y) one += reach * normal(random);
      if (!map_.project(y) || !(map_.plane_rate(y) > 0) || y.norm() > 5 * size) continue;
      follow(y, kFollowed);
    }
  }

  void follow(Vector x, std::size_t points) {
    std::vector<Vector> orbit;
    for (std::size_t k = 0; k < points; ++k) {
      const auto next = map_(x, false);
      if (!next || (give_up_ && give_up_())) break;
      x = next->state;
      if (!map_.project(x)) break;
      orbit.push_back(x);
    }
    if (orbit.size() > longest_) orbits_.push_back(std::move(orbit));
  }

  /// Where orbits come back to themselves most nearly, of each orbit its share.
  std::vector<Vector> starts_of(std::size_t length) const {
    std::vector<std::pair<double, Vector>> near;
    for (const std::vector<Vector>& orbit : orbits_)
      for (std::size_t k = 0; k + length < orbit.size(); ++k)
        near.emplace_back((orbit[k + length] - orbit[k]).norm(), orbit[k]);
    std::ranges::stable_sort(near, {}, [](const auto& one) { return one.first; });
    std::vector<Vector> result;
    double apart = 0;
    for (const auto& [distance, x] : near) apart = std::max(apart, (x - near[0].second).norm());
    // Not all of them next to one cycle.
    for (const auto& [distance, x] : near) {
      if (result.size() >= kStartsOfALength) break;
      const bool is_new = std::ranges::none_of(
          result, [&, &x = x](const Vector& other) { return (other - x).norm() < 0.015 * apart; });
      if (is_new) result.push_back(x);
    }
    return result;
  }

  std::optional<HyperbolicCycle> newton(Vector x, std::size_t length) const {
    const double size = 1e-3 + x.norm();
    for (int round = 0; round < kRoundsOfFixedPoint; ++round) {
      const auto orbit = iterated(map_, x, length);
      if (!orbit) return std::nullopt;
      Matrix product = Matrix::Identity(2, 2);
      for (const Matrix& d : orbit->derivatives) product = d * product;
      const Vector miss = orbit->bases[0].transpose() * (orbit->returns.back().state - x);
      Vector step = -shortest_solution(product - Matrix::Identity(2, 2), miss, 1e-14);
      if (!step.allFinite()) return std::nullopt;
      if (step.norm() < 1e-12 * size) {
        if ((orbit->returns.back().state - x).norm() > 1e-8 * size) return std::nullopt;
        return described(x, *orbit, product);
      }
      // From afar, Newton's method arrives nowhere.
      if (round > 6 && step.norm() > 0.05 * size) return std::nullopt;
      if (step.norm() > 0.1 * size) step *= 0.1 * size / step.norm();
      x += orbit->bases[0] * step;
      if (!map_.project(x) || !(map_.plane_rate(x) > 0)) return std::nullopt;
    }
    return std::nullopt;
  }

  static std::optional<HyperbolicCycle> described(const Vector& x, const IteratedReturn& orbit,
                                                  const Matrix& product) {
    const double trace = product.trace(),
                 determinant = product(0, 0) * product(1, 1) - product(0, 1) * product(1, 0);
    const double discriminant = trace * trace / 4 - determinant;
    if (!(discriminant > 0)) return std::nullopt;
    HyperbolicCycle cycle;
    cycle.unstable = trace / 2 + std::copysign(std::sqrt(discriminant), trace);
    cycle.stable = determinant / cycle.unstable;
    if (!(std::abs(cycle.unstable) > 1) || !(std::abs(cycle.stable) < 1)) return std::nullopt;
    Vector point = x, unstable = eigenvector(product, cycle.unstable),
           stable = eigenvector(product, cycle.stable);
    for (std::size_t k = 0; k < orbit.returns.size(); ++k) {
      cycle.points.push_back(point);
      cycle.times.push_back(orbit.returns[k].time);
      cycle.unstable_directions.push_back(orbit.bases[k] * unstable);
      cycle.stable_directions.push_back(orbit.bases[k] * stable);
      Matrix both(2, 2), inverse(2, 2);
      both << unstable, stable;
      const double area = both(0, 0) * both(1, 1) - both(0, 1) * both(1, 0);
      if (!(std::abs(area) > 1e-9)) return std::nullopt;
      inverse << both(1, 1), -both(0, 1), -both(1, 0), both(0, 0);
      cycle.parts.push_back(times(inverse / area, orbit.bases[k].transpose()));
      unstable = (orbit.derivatives[k] * unstable).normalized();
      // What the contraction leaves of it may be rounding: from the way back.
      stable = stable_at(orbit, cycle.stable, product, k + 1);
      point = orbit.returns[k].state;
    }
    return cycle;
  }

  /// The stable direction at the point k of the cycle, from that of the last by the adjugates of
  /// the derivatives, which are their inverses up to a factor.
  static Vector stable_at(const IteratedReturn& orbit, double value, const Matrix& product,
                          std::size_t k) {
    Vector direction = eigenvector(product, value);
    for (std::size_t j = orbit.derivatives.size(); j-- > k;) {
      const Matrix& d = orbit.derivatives[j];
      Matrix adjugate(2, 2);
      adjugate << d(1, 1), -d(0, 1), -d(1, 0), d(0, 0);
      direction = (adjugate * direction).normalized();
    }
    return direction;
  }

  /// Of a 2 x 2 matrix and a simple eigenvalue.
  static Vector eigenvector(const Matrix& m, double value) {
    Vector first(2), second(2);
    first << m(0, 1), value - m(0, 0);
    second << value - m(1, 1), m(1, 0);
    return (first.norm() > second.norm() ? first : second).normalized();
  }

  void keep(const HyperbolicCycle& cycle) {
    if (!(cycle.growth() > kLeastGrowth)) return;
    for (std::size_t k = 1; k < cycle.length(); ++k)
      if ((cycle.points[k] - cycle.points[0]).norm() < kSameOrbit * (1 + cycle.points[0].norm()))
        return;  // a shorter one
    for (const HyperbolicCycle& other : found_)
      for (const Vector& point : other.points)
        if ((point - cycle.points[0]).norm() < kSameOrbit * (1 + point.norm())) return;
    found_.push_back(cycle);
  }

  const SectionSystem& system_;
  const NumericReturn& map_;
  std::size_t longest_;
  const std::function<bool()>& give_up_;
  std::vector<std::vector<Vector>> orbits_;
  std::vector<HyperbolicCycle> found_;
};

}  // namespace

double HyperbolicCycle::growth() const {
  return std::pow(std::abs(unstable), 1. / static_cast<double>(length()));
}

std::vector<HyperbolicCycle> hyperbolic_cycles(const SectionSystem& system,
                                               const NumericReturn& map, std::size_t longest,
                                               const std::function<bool()>& give_up) {
  return CycleFinder(system, map, longest, give_up).run();
}

}  // namespace casimir::horseshoe
