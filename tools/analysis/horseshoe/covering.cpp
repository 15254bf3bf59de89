#include "tools/analysis/horseshoe/covering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace casimir::horseshoe {
namespace {

using validated::MidRad;
using validated::upwards;

std::vector<validated::Integral> integrals_of(const SectionSystem& system) {
  std::vector<validated::Integral> result;
  for (const KnownIntegral& known : system.integrals)
    result.push_back({known.name, known.value, known.gradient, known.states});
  return result;
}

/// At the precision that contraction works with.
std::vector<validated::ArbBall> levels_of(const SectionSystem& system) {
  const validated::BallPrecision precision(192);
  std::vector<validated::ArbBall> result;
  for (const RationalInterval& level : system.levels) {
    validated::ArbBall low(level.low), high(level.high);
    arb_union(low.raw(), low.raw(), high.raw(), 192);
    result.push_back(low);
  }
  return result;
}

bool above(const MidRad& y, double bound) {
  return validated::is_usable(y) && y.mid - upwards(y.rad + 2e-16 * std::abs(y.mid)) > bound;
}
bool below(const MidRad& y, double bound) { return above(-y, -bound); }
bool smaller(const MidRad& y, double bound) { return below(y, bound) && above(y, -bound); }

}  // namespace

/// The image of a part in the coordinates of a target, and what of y_1 and y_2 is due to the extent
/// of the part along a and b.
template <class Ball>
struct Coverings<Ball>::Image {
  std::vector<MidRad> y;
  double by_a = 0, by_b = 0;
};

/// What is left to do of an h-set.
template <class Ball>
struct Coverings<Ball>::Work {
  CoveringOutcome outcome;
  std::vector<int> sides;  ///< of each target: where the edge a = 1 was found; 0: not known yet
};

template <class Ball>
Coverings<Ball>::Coverings(const SectionSystem& system, const NumericReturn& map,
                           CoveringSettings settings)
    : map_(map),
      settings_(std::move(settings)),
      flow_(validated::joined(system.rates, system.jacobian.program, system.jacobian.entries)),
      integrals_(integrals_of(system)),
      chart_(system),
      return_(flow_, integrals_, levels_of(system), system.plane, settings_.returns) {}

template <class Ball>
bool Coverings<Ball>::may_go_on(Work& work) const {
  if (settings_.give_up && settings_.give_up())
    work.outcome.reason = "no time was left";
  else if (work.outcome.parts >= settings_.most_parts)
    work.outcome.reason = "it was divided into as many parts as are allowed";
  return work.outcome.reason.empty();
}

/// The first return of a part. \return  whether it is proved.
template <class Ball>
bool Coverings<Ball>::enclose(const HSet& set, const Patch& patch) {
  const validated::AffineSet part = chart_.part(set, patch);
  const auto n = static_cast<Eigen::Index>(set.states());
  const auto expected = map_(Eigen::Map<const Eigen::VectorXd>(part.middle.data(), n), false);
  return expected && return_.find(part, expected->time);
}

template <class Ball>
typename Coverings<Ball>::Image Coverings<Ball>::image_in(const HSet& target) const {
  const validated::FirstReturn<Ball>& found = return_.result();
  const std::size_t n = target.states();
  Image image;
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<Ball> row(n);
    for (std::size_t i = 0; i < n; ++i) row[i] = Ball(target.inverse(k, i));
    image.y.push_back(validated::outwards(found.along_row(row, target.centre)));
    if (k >= 2) continue;
    double by[2] = {0, 0};
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t i = 0; i < n; ++i)
        by[j] += approximate(row[i]) * approximate(found.by_along(i, j));
      by[j] = std::abs(by[j]) * radius_of(found.along[j]);
    }
    image.by_a = std::max(image.by_a, by[0]);
    image.by_b = std::max(image.by_b, by[1]);
  }
  return image;
}

template <class Ball>
typename Coverings<Ball>::Place Coverings<Ball>::place_of(const Image& image,
                                                          const HSet& target) const {
  const MidRad &y1 = image.y[0], &y2 = image.y[1];
  if (below(y1, -1)) return Place::left;
  if (above(y1, 1)) return Place::right;
  // Certainly beyond the edges that no image may meet.
  if (smaller(y1, 1) && (above(y2, 1) || below(y2, -1))) return Place::missed;
  if (!smaller(y2, 1)) return Place::unknown;
  for (std::size_t k = 2; k < image.y.size() && !settings_.without_sheet; ++k)
    if (!smaller(image.y[k], target.sheet[k - 2])) return Place::unknown;
  return Place::inside;
}

/// (2), for one edge and all targets.
template <class Ball>
bool Coverings<Ball>::edge(const HSet& set, const std::vector<const HSet*>& targets, double a,
                           Work& work) {
  std::vector<Patch> waiting{{a, 0, 0, 1}};
  while (!waiting.empty()) {
    if (!may_go_on(work)) return false;
    const Patch patch = waiting.back();
    waiting.pop_back();
    ++work.outcome.parts;
    bool known = enclose(set, patch);
    for (std::size_t j = 0; known && j < targets.size(); ++j) {
      const Place place = place_of(image_in(*targets[j]), *targets[j]);
      known = place == Place::left || place == Place::right;
      if (!known && place != Place::unknown) {
        work.outcome.reason =
            fmt::format("an edge of {} is not mapped across {}", set.name, targets[j]->name);
        return false;
      }
      if (!known) break;
      // The edge a = 1 on one side means that a = -1 is on the other.
      const int side = (place == Place::right ? 1 : -1) * (a > 0 ? 1 : -1);
      if (work.sides[j] == 0) work.sides[j] = side;
      if (work.sides[j] != side) {
        work.outcome.reason = fmt::format("both edges of {} are mapped to one side of {}", set.name,
                                          targets[j]->name);
        return false;
      }
    }
    if (known) continue;
    if (patch.half_b < 0x1p-12) {
      work.outcome.reason = fmt::format("where an edge of {} is mapped to is not certain: {}",
                                        set.name, return_.reason());
      return false;
    }
    waiting.push_back({a, 0, patch.b - patch.half_b / 2, patch.half_b / 2});
    waiting.push_back({a, 0, patch.b + patch.half_b / 2, patch.half_b / 2});
  }
  return true;
}

/// (1), (3) and (4), for all targets.
template <class Ball>
bool Coverings<Ball>::body(const HSet& set, const std::vector<const HSet*>& targets, Work& work) {
  std::vector<Patch> waiting{{}};
  while (!waiting.empty()) {
    if (!may_go_on(work)) return false;
    const Patch patch = waiting.back();
    waiting.pop_back();
    ++work.outcome.parts;
    bool known = enclose(set, patch);
    double by_a = patch.half_a, by_b = patch.half_b;
    for (std::size_t j = 0; known && j < targets.size(); ++j) {
      const Image image = image_in(*targets[j]);
      const Place place = place_of(image, *targets[j]);
      if (place == Place::missed) {
        work.outcome.reason =
            fmt::format("{} is mapped over the stable edges of {}", set.name, targets[j]->name);
        return false;
      }
      if (place != Place::unknown) continue;
      known = false;
      by_a = image.by_a;
      by_b = image.by_b;
    }
    if (known) continue;
    const bool along = by_a >= by_b;
    if ((along ? patch.half_a : patch.half_b) < 0x1p-14) {
      work.outcome.reason =
          fmt::format("where {} is mapped to is not certain: {}", set.name, return_.reason());
      return false;
    }
    for (const double side : {-0.5, 0.5}) {
      Patch half = patch;
      (along ? half.a : half.b) += side * (along ? patch.half_a : patch.half_b);
      (along ? half.half_a : half.half_b) /= 2;
      waiting.push_back(half);
    }
  }
  return true;
}

template <class Ball>
CoveringOutcome Coverings<Ball>::check(const HSet& set, const std::vector<const HSet*>& targets) {
  Work work;
  work.sides.assign(targets.size(), 0);
  try {
    work.outcome.proved = (settings_.without_edges ||
                           (edge(set, targets, -1, work) && edge(set, targets, 1, work))) &&
                          body(set, targets, work);
  } catch (const std::domain_error& problem) {
    work.outcome.reason = fmt::format("the functions are not certain to have a value on {}: {}",
                                      set.name, problem.what());
  }
  return work.outcome;
}

template class Coverings<MidRad>;
template class Coverings<validated::ArbBall>;

}  // namespace casimir::horseshoe
