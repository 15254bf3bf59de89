#include "tools/analysis/section/spread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "symbolic/error.hpp"

namespace casimir {
namespace {

using Vector = LevelSet::Vector;

constexpr int kRandomPointsOfLevel = 1500, kRoundsOfSpread = 5, kParents = 120, kChildren = 4;
/// Points that are crossed at a smaller angle are next to tangencies.
constexpr double kLeastSpeed = 1e-6;
constexpr double kFarAway = 30;
/// To a side of the picture.
constexpr double kCells = 100;
constexpr int kCentrings = 3;

/// Numbers that are the same with every standard library.
class Chance {
 public:
  /// From -1 to 1.
  double operator()() { return std::ldexp(static_cast<double>(engine_() >> 11), -52) - 1; }

 private:
  std::mt19937_64 engine_{20190719};
};

double size_of_scene(const LevelSet& level) {
  double size = 0;
  for (const double x : level.problem().run.initial) size = std::max(size, std::abs(x));
  return size > 0 ? size : 1;
}

/// A point of a size, or one of several near it.
Vector anywhere(const LevelSet& level, double scale, Chance& chance, int number) {
  constexpr double kSizes[] = {0.3, 1, 3};
  const double size = kSizes[number % 3] * scale;
  Vector x(static_cast<Eigen::Index>(level.problem().states()));
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = (level.problem().angles[static_cast<std::size_t>(i)] ? std::acos(-1.) : size) * chance();
  return x;
}

/// From b to a in the picture, whose sides have the lengths `sides`; angles the short way round.
std::array<double, 2> way(const LevelSet& level, const std::array<double, 2>& sides,
                          const std::array<double, 2>& a, const std::array<double, 2>& b) {
  std::array<double, 2> result{};
  for (std::size_t k = 0; k < 2; ++k) {
    double d = a[k] - b[k];
    const double period = level.problem().plotted[k].period;
    if (period > 0) d -= period * std::round(d / period);
    result[k] = d / sides[k];
  }
  return result;
}

double distance(const LevelSet& level, const std::array<double, 2>& sides,
                const std::array<double, 2>& a, const std::array<double, 2>& b) {
  const auto [x, y] = way(level, sides, a, b);
  return std::sqrt(x * x + y * y);
}

std::array<double, 2> sides_of(const LevelSet& level, const std::vector<PlacedPoint>& points) {
  std::array<double, 2> sides{};
  for (std::size_t k = 0; k < 2; ++k) {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (const PlacedPoint& point : points) {
      least = std::min(least, point.place[k]);
      largest = std::max(largest, point.place[k]);
    }
    const double period = level.problem().plotted[k].period;
    sides[k] = period > 0 ? period : largest > least ? largest - least : 1;
  }
  return sides;
}

class Search {
 public:
  /// \param size  of the points that are looked for
  Search(const LevelSet& level, const Returning& returning, double size)
      : level_(level), returning_(returning), size_(size) {}

  void add(Vector x) {
    if (!level_.project(x) || level_.speed(x) < kLeastSpeed) return;
    if (x.norm() > kFarAway * size_ * std::sqrt(static_cast<double>(x.size()))) return;
    const std::array<double, 2> place = level_.plotted(x.data());
    if (std::isfinite(place[0]) && std::isfinite(place[1])) fresh_.push_back({x, place});
  }

  /// Keeps those of the new points that orbits return from.
  void sift() {
    const std::vector<bool> keep = returning_(fresh_);
    for (std::size_t i = 0; i < fresh_.size(); ++i)
      if (keep[i]) points_.push_back(std::move(fresh_[i]));
    fresh_.clear();
  }

  void random(int count) {
    for (int i = 0; i < count; ++i) add(anywhere(level_, size_, chance_, i));
  }

  /// Further points from the sparsest parts.
  void grow() {
    for (const PlacedPoint& parent : spread_out(level_, points_, kParents)) {
      const Eigen::MatrixXd basis = level_.tangent(parent.x);
      for (int child = 0; child < kChildren; ++child) {
        Vector direction(basis.cols());
        for (Eigen::Index i = 0; i < direction.size(); ++i) direction[i] = chance_();
        add(parent.x + size_ * std::ldexp(0.5, -child) * (basis * direction));
      }
    }
  }

  std::vector<PlacedPoint> points() { return std::move(points_); }
  bool empty() const { return points_.empty(); }

 private:
  const LevelSet& level_;
  const Returning& returning_;
  const double size_;
  Chance chance_;
  std::vector<PlacedPoint> fresh_, points_;
};

}  // namespace

namespace {

std::vector<PlacedPoint> points_of_size(const LevelSet& level, const Returning& returning,
                                        double size, const std::vector<Vector>& known) {
  Search search(level, returning, size);
  for (const Vector& x : known) search.add(x);
  search.random(kRandomPointsOfLevel);
  search.sift();
  for (int round = 0; round < kRoundsOfSpread && !search.empty(); ++round) {
    search.grow();
    search.sift();
  }
  return search.points();
}

/// Powers of ten times the size of the scene, the nearest first, from which points come to the
/// level without leaving that size: a level of another energy may lie far from the scene.
std::vector<double> other_sizes(const LevelSet& level) {
  constexpr int kDecades = 20, kTrials = 30, kEnough = 3;
  Chance chance;
  std::vector<double> sizes;
  for (int k = 1; k <= 2 * kDecades; ++k) {
    const double size = size_of_scene(level) * std::pow(10., k % 2 == 1 ? (k + 1) / 2 : -k / 2);
    int there = 0;
    for (int i = 0; i < kTrials; ++i) {
      Vector x = anywhere(level, size, chance, i);
      if (!level.project(x)) continue;
      const double largest = x.lpNorm<Eigen::Infinity>();
      there += largest > size / kFarAway && largest < size * kFarAway ? 1 : 0;
    }
    if (there >= kEnough) sizes.push_back(size);
  }
  return sizes;
}

}  // namespace

std::vector<PlacedPoint> points_of_domain(const LevelSet& level, const Returning& returning,
                                          const std::vector<Vector>& known) {
  std::vector<PlacedPoint> points = points_of_size(level, returning, size_of_scene(level), known);
  constexpr std::size_t kMostSizes = 4;
  std::size_t tried = 0;
  if (points.empty()) {
    for (const double size : other_sizes(level)) {
      points = points_of_size(level, returning, size, {});
      if (!points.empty() || ++tried == kMostSizes) break;
    }
  }
  return points;
}

namespace {

/// One place for each small part of the picture that has any.
PicturePlaces thinned(const std::array<double, 2>& sides, const PicturePlaces& places) {
  std::map<std::pair<long, long>, std::array<double, 2>> cells;
  for (const auto& place : places)
    cells.try_emplace(
        {std::lround(kCells * place[0] / sides[0]), std::lround(kCells * place[1] / sides[1])},
        place);
  PicturePlaces result;
  for (const auto& [cell, place] : cells) result.push_back(place);
  return result;
}

}  // namespace

std::vector<PlacedPoint> spread_out(const LevelSet& level, const std::vector<PlacedPoint>& points,
                                    std::size_t count, const PicturePlaces& taken) {
  const std::array<double, 2> sides = sides_of(level, points);
  std::array<double, 2> middle{};
  for (const PlacedPoint& point : points)
    for (std::size_t k = 0; k < 2; ++k)
      middle[k] += point.place[k] / static_cast<double>(points.size());
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  const PicturePlaces others = thinned(sides, taken);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& place : others)
      nearest[i] = std::min(nearest[i], distance(level, sides, points[i].place, place));
    if (others.empty()) nearest[i] = 1 / (1 + distance(level, sides, points[i].place, middle));
  }
  std::vector<PlacedPoint> chosen;
  while (chosen.size() < std::min(count, points.size())) {
    const auto next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
    if (!(nearest[next] > 0)) break;  // what is left lies where others are
    const bool first = chosen.empty() && others.empty();
    chosen.push_back(points[next]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d = distance(level, sides, points[i].place, points[next].place);
      nearest[i] = first ? d : std::min(nearest[i], d);
    }
  }
  return chosen;
}

std::vector<PlacedPoint> centred(const LevelSet& level, const std::vector<PlacedPoint>& points,
                                 std::vector<PlacedPoint> chosen) {
  const std::array<double, 2> sides = sides_of(level, points);
  PicturePlaces all;
  for (const PlacedPoint& point : points) all.push_back(point.place);
  all = thinned(sides, all);
  const auto nearest_of = [&](const std::vector<PlacedPoint>& list,
                              const std::array<double, 2>& to) {
    return static_cast<std::size_t>(
        std::ranges::min_element(
            list, {},
            [&](const PlacedPoint& point) { return distance(level, sides, point.place, to); }) -
        list.begin());
  };
  for (int round = 0; round < kCentrings && !chosen.empty(); ++round) {
    std::vector<std::array<double, 3>> sums(chosen.size());  // of the ways, and their number
    for (const auto& place : all) {
      const std::size_t owner = nearest_of(chosen, place);
      const auto [x, y] = way(level, sides, place, chosen[owner].place);
      sums[owner][0] += x;
      sums[owner][1] += y;
      sums[owner][2] += 1;
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (sums[i][2] == 0) continue;
      std::array<double, 2> middle = chosen[i].place;
      for (std::size_t k = 0; k < 2; ++k) middle[k] += sides[k] * sums[i][k] / sums[i][2];
      chosen[i] = points[nearest_of(points, middle)];
    }
  }
  return chosen;
}

namespace {

/// Whether a point of the plane and the level is found that motions cross, and that has no place in
/// the picture.
bool is_crossed_without_place(const LevelSet& level) {
  Chance chance;
  for (int i = 0; i < kRandomPointsOfLevel; ++i) {
    Vector x = anywhere(level, size_of_scene(level), chance, i);
    if (!level.project(x) || level.speed(x) < kLeastSpeed) continue;
    const std::array<double, 2> place = level.plotted(x.data());
    if (!std::isfinite(place[0]) || !std::isfinite(place[1])) return true;
  }
  return false;
}

std::string energies_there(const LevelSet& level) {
  Chance chance;
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (int i = 0; i < 300; ++i) {
    Vector x = anywhere(level, size_of_scene(level), chance, i);
    if (!level.project(x, nullptr, false)) continue;
    largest = std::max(largest, level.energy(x));
    // Downhill along the level, as far as it goes.
    double step = 0.5 * size_of_scene(level);
    for (int moves = 0; step > 1e-6 && moves < 300; ++moves) {
      const Vector gradient = level.energy_gradient(x);
      if (!(gradient.norm() > 0)) break;
      Vector lower = x - step * gradient / gradient.norm();
      if (level.project(lower, nullptr, false) && level.energy(lower) < level.energy(x))
        x = lower;
      else
        step /= 2;
    }
    least = std::min(least, level.energy(x));
  }
  if (!(least <= largest))
    return "no point with these values of the Casimir functions was found on the plane";
  return fmt::format(
      "with these values of the Casimir functions the energies found on the plane begin at {:.6g}",
      least);
}

}  // namespace

std::string why_no_points(const LevelSet& level) {
  const SectionProblem& problem = level.problem();
  const char* direction = problem.plane.upwards ? "upwards" : "downwards";
  if (is_crossed_without_place(level))
    return fmt::format(
        "motions with {} cross the plane {}, but where they were found to do so the plotted "
        "functions {} and {} have no values",
        problem.level_text(), direction, printable(problem.plotted[0].text, 200),
        printable(problem.plotted[1].text, 200));
  return fmt::format("no motion with {} was found that crosses the plane {}; {}",
                     problem.level_text(), direction, energies_there(level));
}

}  // namespace casimir
