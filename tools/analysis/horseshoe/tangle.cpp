#include "tools/analysis/horseshoe/tangle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/step/dense.hpp"

namespace casimir::horseshoe {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// By how much images reach over what they are to cover, and stay within.
constexpr double kMargin = 1.5;
constexpr double kLeastMargin = 1.04;
/// Sets are not thinner across than that share of their length.
constexpr double kThinnest = 0.02;
/// A set at a cycle reaches so far of the way to the excursion at least.
constexpr double kReach = 0.4;
/// Largest and smallest distances from a cycle at which an excursion begins and ends, in sizes of
/// the section.
constexpr double kFarthest = 0.25, kNearest = 5e-5;

double part_of(const HyperbolicCycle& cycle, std::size_t phase, const Vector& x, int which) {
  return std::abs((cycle.parts[phase] * (x - cycle.points[phase]))[which]);
}

class Planner {
 public:
  Planner(const NumericReturn& map, const std::vector<HyperbolicCycle>& cycles,
          const std::vector<Excursion>& excursions, double size)
      : map_(map), cycles_(cycles), excursions_(excursions), size_(size) {}

  std::optional<PlannedTangle> plan() {
    for (std::size_t e = 0; e < excursions_.size(); ++e)
      if (!add_cycle(e)) return std::nullopt;
    for (std::size_t e = 0; e < excursions_.size(); ++e)
      if (!add_excursion(e)) return std::nullopt;
    for (const auto& [from, to] : tangle_.arrows) {
      const auto needed = across_needed(tangle_.sets[from], tangle_.sets[to]);
      if (!needed || *needed * kLeastMargin > tangle_.sets[to].half_across) return std::nullopt;
    }
    return std::move(tangle_);
  }

 private:
  /// The excursion that arrives at the cycle where excursion e begins.
  const Excursion& arriving(std::size_t e) const {
    return excursions_[(e + excursions_.size() - 1) % excursions_.size()];
  }
  const HyperbolicCycle& cycle_of(std::size_t e) const {
    return cycles_[excursions_[e].connection->from];
  }
  static std::size_t phase_at(const Excursion& excursion, std::size_t index,
                              const HyperbolicCycle& to) {
    const std::size_t length = to.length(), before = excursion.connection->arrival;
    return (excursion.connection->phase + length * (before + 1) + index - before) % length;
  }

  PlannedSet set_at(std::string name, const Vector& centre, const Vector& along,
                    const Vector& across) const {
    PlannedSet set{std::move(name), centre, along, across, 0, 0, {}};
    const Matrix gradients = map_.gradients(centre);
    Matrix frame(centre.size(), centre.size());
    frame.col(0) = along;
    frame.col(1) = across;
    frame.col(2) = map_.rates(centre);
    for (Eigen::Index k = 1; k < gradients.cols(); ++k) frame.col(k + 2) = gradients.col(k);
    set.parts = inverted(frame).topRows(2);
    return set;
  }

  Vector point_of(const PlannedSet& set, double a, double b) const {
    Vector x = set.centre + a * set.half_along * set.along + b * set.half_across * set.across;
    map_.project(x);
    return x;
  }

  std::optional<Vector> image(const PlannedSet& set, double a, double b,
                              const PlannedSet& target) const {
    const auto next = map_(point_of(set, a, b), false);
    if (!next) return std::nullopt;
    Vector y = target.parts * (next->state - target.centre);
    y[0] /= target.half_along;
    return y;
  }

  /// How far across a set has to reach to hold the image of another, so far as some points show;
  /// nothing where that does not reach over it.
  std::optional<double> across_needed(const PlannedSet& set, const PlannedSet& target) const {
    double needed = 0;
    for (const double b : {-1., 0., 1.}) {
      const auto left = image(set, -1, b, target), right = image(set, 1, b, target);
      if (!left || !right || (*left)[0] * (*right)[0] > 0) return std::nullopt;
      if (std::min(std::abs((*left)[0]), std::abs((*right)[0])) < kLeastMargin) return std::nullopt;
      for (const double wanted : {-1., 0., 1.}) {
        const auto there = image_at(set, b, target, wanted, (*left)[0], (*right)[0]);
        if (!there) return std::nullopt;
        needed = std::max(needed, std::abs((*there)[1]));
      }
    }
    return needed;
  }

  /// The image with the first coordinate `wanted`, by the secant rule with halved ends (Illinois).
  std::optional<Vector> image_at(const PlannedSet& set, double b, const PlannedSet& target,
                                 double wanted, double left, double right) const {
    double from = -1, to = 1, f = left - wanted, g = right - wanted;
    std::optional<Vector> y;
    constexpr int kRounds = 60;
    for (int round = 0; round < kRounds; ++round) {
      const double a = round % 3 == 2 ? 0.5 * (from + to) : (from * g - to * f) / (g - f);
      y = image(set, a, b, target);
      if (!y) return std::nullopt;
      const double h = (*y)[0] - wanted;
      if (std::abs(h) < 0.02) return y;
      if ((h < 0) == (f < 0)) {
        from = a;
        f = h;
        g /= 2;
      } else {
        to = a;
        g = h;
        f /= 2;
      }
    }
    return y;
  }

  /// The sets at the points of a cycle: between what leaves it and what comes to it.
  bool add_cycle(std::size_t e) {
    const HyperbolicCycle& cycle = cycle_of(e);
    const Excursion &leaving = excursions_[e], &coming = arriving(e);
    const std::size_t length = cycle.length(), first = tangle_.sets.size();
    first_.push_back(first);
    for (std::size_t k = 0; k < length; ++k)
      tangle_.sets.push_back(set_at(fmt::format("{}{}", letter(e), k), cycle.points[k],
                                    cycle.unstable_directions[k], cycle.stable_directions[k]));
    std::vector<double> along{1}, across{1};
    const double growth = cycle.growth(),
                 decay = std::pow(std::abs(cycle.stable), 1. / static_cast<double>(length));
    for (std::size_t k = 0; k + 1 < length; ++k) {
      const auto next = map_(cycle.points[k], true);
      if (!next) return false;
      const auto by = [&](const Vector& direction) {
        return (next->derivative * direction).norm();
      };
      along.push_back(along.back() * by(cycle.unstable_directions[k]) / growth);
      across.push_back(across.back() * std::clamp(by(cycle.stable_directions[k]) / decay, 0.2, 5.));
    }
    const std::size_t phase = leaving.departure % length;
    const double out = part_of(cycle, phase, leaving.connection->orbit[leaving.departure], 0) /
                       along[phase] * std::max(kReach, 1 / std::sqrt(growth));
    for (std::size_t k = 0; k < length; ++k) {
      tangle_.sets[first + k].half_along = out * along[k];
      tangle_.arrows.emplace_back(first + k, first + (k + 1) % length);
    }
    return set_across(cycle, coming, first, across, std::min(decay, 0.9));
  }

  /// Across they reach over the end of the excursion that comes, but not to the last point before.
  bool set_across(const HyperbolicCycle& cycle, const Excursion& coming, std::size_t first,
                  const std::vector<double>& across, double decay) {
    const std::size_t length = cycle.length(), end = coming.arrival;
    const std::size_t phase = phase_at(coming, end, cycle), before = (phase + length - 1) % length;
    double least = part_of(cycle, phase, coming.connection->orbit[end], 1) * 1.25 / across[phase];
    double most = kFarthest * size_;
    if (end > coming.connection->arrival)
      most = part_of(cycle, before, coming.connection->orbit[end - 1], 1) * 0.8 / across[before];
    for (std::size_t k = 0; k < length; ++k) {
      PlannedSet &set = tangle_.sets[first + k], &next = tangle_.sets[first + (k + 1) % length];
      least = std::max(least, kThinnest * set.half_along / across[k]);
      set.half_across = 0;
      const auto curved = across_needed(set, next);
      if (!curved) return false;
      least = std::max(least, *curved * kMargin / (1 - decay) / across[(k + 1) % length]);
    }
    if (!(least < most)) return false;
    for (std::size_t k = 0; k < length; ++k)
      tangle_.sets[first + k].half_across = std::sqrt(least * most) * across[k];
    return true;
  }

  bool add_excursion(std::size_t e) {
    const Excursion& excursion = excursions_[e];
    const Connection& way = *excursion.connection;
    const HyperbolicCycle &from = cycle_of(e), &to = cycles_[way.to];
    const std::size_t first = tangle_.sets.size(), begin = excursion.departure,
                      end = excursion.arrival, last = first + (end - begin) - 1;
    const std::size_t to_cycle = (e + 1) % excursions_.size();
    const std::size_t phase = phase_at(excursion, end, to);
    for (std::size_t k = begin; k < end; ++k)
      tangle_.sets.push_back(
          set_at(fmt::format("{}{}_{}", letter(e), letter(to_cycle), k - begin + 1), way.orbit[k],
                 way.unstable[k], way.stable[k]));
    const std::size_t leaves = first_[e] + (begin + from.length() - 1) % from.length();
    const std::size_t arrives = first_[to_cycle] + phase;
    double length =
        tangle_.sets[arrives].half_along / std::abs((to.parts[phase] * way.unstable[end])[0]);
    for (std::size_t k = end; k-- > begin;) {
      length *= kMargin / way.growth[k];
      tangle_.sets[first + k - begin].half_along = length;
    }
    std::size_t before = leaves;
    for (std::size_t k = first; k <= last; ++k) {
      PlannedSet& set = tangle_.sets[k];
      const auto needed = across_needed(tangle_.sets[before], set);
      if (!needed) return false;
      set.half_across = std::max(kMargin * *needed, kThinnest * set.half_along);
      tangle_.arrows.emplace_back(before, k);
      before = k;
    }
    tangle_.arrows.emplace_back(last, arrives);
    return true;
  }

  static char letter(std::size_t cycle) { return static_cast<char>('A' + static_cast<int>(cycle)); }

  const NumericReturn& map_;
  const std::vector<HyperbolicCycle>& cycles_;
  const std::vector<Excursion>& excursions_;
  double size_;
  PlannedTangle tangle_;
  std::vector<std::size_t> first_;  ///< of the sets of each cycle
};

}  // namespace

std::vector<Excursion> excursions(const std::vector<HyperbolicCycle>& cycles,
                                  const Connection& connection, double size) {
  const HyperbolicCycle &from = cycles[connection.from], &to = cycles[connection.to];
  std::vector<Excursion> result;
  for (std::size_t begin = 1; begin < connection.arrival; ++begin) {
    const double out = part_of(from, begin % from.length(), connection.orbit[begin], 0);
    const double distance = (connection.orbit[begin] - from.points[begin % from.length()]).norm();
    if (out < kNearest * size) continue;
    // Beyond, the orbit is not along the unstable direction any more.
    if (out > kFarthest * size || distance > 1.5 * out) break;
    for (std::size_t end = std::max(begin + 1, connection.arrival); end < connection.orbit.size();
         ++end) {
      const std::size_t phase = (connection.phase + end - connection.arrival) % to.length();
      if (part_of(to, phase, connection.orbit[end], 1) > kFarthest * size) continue;
      result.push_back({&connection, begin, end});
    }
  }
  std::ranges::stable_sort(result, {},
                           [](const Excursion& one) { return one.arrival - one.departure; });
  return result;
}

std::optional<PlannedTangle> planned_tangle(const NumericReturn& map,
                                            const std::vector<HyperbolicCycle>& cycles,
                                            const std::vector<Excursion>& excursions, double size) {
  return Planner(map, cycles, excursions, size).plan();
}

}  // namespace casimir::horseshoe
