#include "tools/analysis/horseshoe/connections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/step/dense.hpp"

namespace casimir::horseshoe {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Places in a fundamental domain of an unstable branch, returns that are followed, where it
/// begins and how near a cycle it has to come, both in sizes of the section.
constexpr int kBranchPlaces = 260;
constexpr std::size_t kReturnsOfManifold = 14;
constexpr double kStart = 1e-5, kNearCycle = 0.3, kArrivedAtCycle = 2e-4;
/// Connections along which the two directions cannot be told apart prove nothing.
constexpr double kLeastAngle = 1e-6;
constexpr std::size_t kMostOfAPair = 12;

/// A point on the unstable line of a cycle followed for some returns.
using Orbit = std::vector<Vector>;

/// Where two neighbours on the line pass the stable line of a cycle on different sides.
struct Bracket {
  double from, to;
  std::size_t returns, target, phase;
};

class ConnectionFinder {
 public:
  ConnectionFinder(const NumericReturn& map, const std::vector<HyperbolicCycle>& cycles,
                   std::size_t from, const std::vector<std::size_t>& to, double size,
                   const std::function<bool()>& give_up)
      : map_(map), cycles_(cycles), from_(from), to_(to), size_(size), give_up_(give_up) {}

  std::vector<Connection> run() {
    for (const double side : {1., -1.}) scan(side);
    std::ranges::stable_sort(brackets_, {}, &Bracket::returns);
    for (const std::size_t target : to_) {
      std::size_t count = 0;
      for (const Bracket& bracket : brackets_) {
        if (bracket.target != target || count == kMostOfAPair || late()) continue;
        if (auto found = refined(bracket)) {
          found_.push_back(std::move(*found));
          ++count;
        }
      }
    }
    return std::move(found_);
  }

 private:
  bool late() const { return give_up_ && give_up_(); }
  const HyperbolicCycle& source() const { return cycles_[from_]; }

  Vector place(double t) const {
    Vector x = source().points[0] + t * source().unstable_directions[0];
    map_.project(x);
    return x;
  }

  Orbit followed(double t, std::size_t returns) const {
    Orbit orbit{place(t)};
    for (std::size_t k = 0; k < returns; ++k) {
      const auto next = map_(orbit.back(), false);
      if (!next) break;
      orbit.push_back(next->state);
    }
    return orbit;
  }

  Vector parts(const Vector& x, std::size_t target, std::size_t phase) const {
    return cycles_[target].parts[phase] * (x - cycles_[target].points[phase]);
  }

  bool near(const Vector& x, std::size_t target, std::size_t phase) const {
    return (x - cycles_[target].points[phase]).norm() < kNearCycle * size_;
  }

  /// One fundamental domain of a branch.
  void scan(double side) {
    const double factor = std::abs(source().unstable);
    const std::size_t returns = kReturnsOfManifold * std::max<std::size_t>(1, source().length());
    Orbit before;
    double t_before = 0;
    for (int k = 0; k <= kBranchPlaces && !late(); ++k) {
      const double t =
          side * kStart * size_ * std::pow(factor, static_cast<double>(k) / kBranchPlaces);
      Orbit now = followed(t, returns);
      if (k > 0) compare(before, now, t_before, t);
      before = std::move(now);
      t_before = t;
    }
  }

  void compare(const Orbit& a, const Orbit& b, double t_a, double t_b) {
    for (std::size_t k = 1; k < std::min(a.size(), b.size()); ++k) {
      if ((a[k] - b[k]).norm() > kNearCycle * size_) return;  // neighbours no more
      for (const std::size_t target : to_) {
        for (std::size_t phase = 0; phase < cycles_[target].length(); ++phase) {
          if (!near(a[k], target, phase) || !near(b[k], target, phase)) continue;
          const Vector one = parts(a[k], target, phase), other = parts(b[k], target, phase);
          if ((one[0] < 0) != (other[0] < 0)) brackets_.push_back({t_a, t_b, k, target, phase});
        }
      }
    }
  }

  /// By halves at first, and then by Newton's method where the orbit comes nearer.
  std::optional<Connection> refined(Bracket bracket) const {
    const auto part = [&](double t) -> std::optional<double> {
      const Orbit orbit = followed(t, bracket.returns);
      if (orbit.size() <= bracket.returns || !near(orbit.back(), bracket.target, bracket.phase))
        return std::nullopt;
      return parts(orbit.back(), bracket.target, bracket.phase)[0];
    };
    const auto first = part(bracket.from);
    if (!first) return std::nullopt;
    constexpr int kHalves = 30;
    for (int k = 0; k < kHalves; ++k) {
      const double middle = 0.5 * (bracket.from + bracket.to);
      const auto value = part(middle);
      if (!value) return std::nullopt;
      ((*value < 0) == (*first < 0) ? bracket.from : bracket.to) = middle;
    }
    double t = 0.5 * (bracket.from + bracket.to);
    std::size_t returns = bracket.returns;
    std::optional<Connection> best;
    constexpr int kNearer = 6;
    for (int k = 0; k < kNearer; ++k) {
      const auto arrived = newton(t, returns, bracket);
      if (!arrived) break;
      best = described(t, returns, bracket);
      if (!best || *arrived < kArrivedAtCycle * size_) break;
      returns += cycles_[bracket.target].length();
    }
    return best;
  }

  /// Moves t so that the unstable part after so many returns is zero. \return  the stable part
  std::optional<double> newton(double& t, std::size_t returns, const Bracket& bracket) const {
    double t_now = t;
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds; ++round) {
      Vector x = place(t_now), direction = source().unstable_directions[0];
      for (std::size_t k = 0; k < returns; ++k) {
        const auto next = map_(x, true);
        if (!next) return std::nullopt;
        direction = next->derivative * direction;
        x = next->state;
      }
      if (!near(x, bracket.target, bracket.phase)) return std::nullopt;
      const Vector here = parts(x, bracket.target, bracket.phase);
      const double slope = (cycles_[bracket.target].parts[bracket.phase] * direction)[0];
      const double step = here[0] / slope;
      if (!std::isfinite(step) || std::abs(step) > 0.05 * std::abs(t_now)) return std::nullopt;
      if (std::abs(here[0]) < 1e-3 * std::abs(here[1]) + 1e-10 * size_) {
        t = t_now;
        return std::abs(here[1]);
      }
      t_now -= step;
    }
    return std::nullopt;
  }

  std::optional<Connection> described(double t, std::size_t returns, const Bracket& bracket) const {
    Connection result;
    result.from = from_;
    result.to = bracket.target;
    Vector x = place(t);
    std::vector<Matrix> bases{map_.tangent(x)}, derivatives;
    Vector direction = bases[0].transpose() * source().unstable_directions[0];
    for (std::size_t k = 0; k <= returns; ++k) {
      direction.normalize();
      result.orbit.push_back(x);
      result.unstable.push_back(bases[k] * direction);
      const auto next = map_(x, true);
      if (!next) return std::nullopt;
      result.times.push_back(next->time);
      bases.push_back(map_.tangent(next->state));
      derivatives.push_back(between(bases[k + 1], next->derivative, bases[k]));
      direction = derivatives[k] * direction;
      result.growth.push_back(direction.norm());
      x = next->state;
    }
    add_stable(result, bases, derivatives, bracket);
    result.arrival = bracket.returns;
    const std::size_t length = cycles_[bracket.target].length();
    result.phase = bracket.phase % length;
    if (!(result.angle > kLeastAngle)) return std::nullopt;
    return result;
  }

  /// Backwards from the cycle, by adjugates: inverses up to a factor.
  void add_stable(Connection& result, const std::vector<Matrix>& bases,
                  const std::vector<Matrix>& derivatives, const Bracket& bracket) const {
    const std::size_t last = result.orbit.size() - 1;
    Vector direction =
        (bases[last].transpose() * cycles_[bracket.target].stable_directions[bracket.phase])
            .normalized();
    result.stable.resize(last + 1);
    result.angle = 1;
    for (std::size_t k = last + 1; k-- > 0;) {
      result.stable[k] = bases[k] * direction;
      const Vector u = bases[k].transpose() * result.unstable[k];
      result.angle = std::min(result.angle, std::abs(u[0] * direction[1] - u[1] * direction[0]));
      if (k == 0) break;
      const Matrix& d = derivatives[k - 1];
      Matrix adjugate(2, 2);
      adjugate << d(1, 1), -d(0, 1), -d(1, 0), d(0, 0);
      direction = (adjugate * direction).normalized();
    }
  }

  const NumericReturn& map_;
  const std::vector<HyperbolicCycle>& cycles_;
  std::size_t from_;
  const std::vector<std::size_t>& to_;
  double size_;
  const std::function<bool()>& give_up_;
  std::vector<Bracket> brackets_;
  std::vector<Connection> found_;
};

}  // namespace

std::vector<Connection> connections(const NumericReturn& map,
                                    const std::vector<HyperbolicCycle>& cycles, std::size_t from,
                                    const std::vector<std::size_t>& to, double size,
                                    const std::function<bool()>& give_up) {
  return ConnectionFinder(map, cycles, from, to, size, give_up).run();
}

}  // namespace casimir::horseshoe
