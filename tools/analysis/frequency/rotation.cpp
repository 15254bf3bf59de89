#include "tools/analysis/frequency/rotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "tools/analysis/frequency/spectrum.hpp"

namespace casimir {
namespace {

constexpr double kCircle = 2 * std::numbers::pi;
constexpr double kNoRotation = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewestReturns = 48, kMostParts = 24, kLongestCycle = 256;
constexpr std::size_t kSignals = 6, kLines = 3, kMostMultiple = 5;
/// Beside the size of the coordinates, and beside the extent of the orbit.
constexpr double kPoint = 1e-10, kReturned = 1e-8;
/// How far points may be from the straight line between their neighbours, beside the distance of
/// these: on a smooth curve it is the square of that distance.
constexpr double kInLine = 0.15;
/// So far off one point may be, beside the distance of its neighbours; and how many may be further.
constexpr double kOffLine = 0.35, kMayBeOff = 0.08;
/// The widest gap between phases: wider ones leave open what is between islands.
constexpr double kGap = 0.1, kGapOfPoints = 12;
/// The longest curve, in units of the extent of the orbit: what jumps from island to island is as
/// long as its points are many.
constexpr double kLongestCurve = 12, kLongestStep = 0.02;
/// The mean distance of neighbours on the curve beside that of a point to the nearest of all: what
/// jumps from island to island has other points nearer by.
constexpr double kMostApart = 10;
constexpr std::size_t kLookedAt = 200;
/// So much shorter a line along which the points do not stand as they should shows that the other
/// one is run through several times, and that the number is not known well enough.
constexpr double kShorter = 0.75;
/// So many turns of the orbit at least.
constexpr double kTurns = 5;
/// Errors of a frequency, in units of 1/points: the lines of regular motion are told much better.
constexpr double kWanders = 0.05;

double fraction(double x) { return x - std::floor(x); }

/// Each coordinate in units of its extent; those that do not change are left out.
OrbitPoints scaled(const OrbitPoints& points) {
  const std::size_t n = points.size(), d = points.dimension;
  std::vector<double> low(d, std::numeric_limits<double>::infinity()), high(d, -low[0]);
  double size = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < d; ++i) {
      const double x = points.coordinates[j * d + i];
      low[i] = std::min(low[i], x);
      high[i] = std::max(high[i], x);
      size = std::max(size, std::abs(x));
    }
  double widest = 0;
  for (std::size_t i = 0; i < d; ++i) widest = std::max(widest, high[i] - low[i]);
  OrbitPoints result{
      .dimension = 0, .coordinates = {}, .places = points.places, .periods = points.periods};
  if (!(widest > kPoint * size)) return result;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < d; ++i)
    if (high[i] - low[i] > 1e-6 * widest) kept.push_back(i);
  result.dimension = kept.size();
  for (std::size_t j = 0; j < n; ++j)
    for (const std::size_t i : kept)
      result.coordinates.push_back((points.coordinates[j * d + i] - low[i]) / (high[i] - low[i]));
  return result;
}

double distance(const OrbitPoints& points, std::size_t a, std::size_t b) {
  double sum = 0;
  for (std::size_t i = 0; i < points.dimension; ++i) {
    const double x =
        points.coordinates[a * points.dimension + i] - points.coordinates[b * points.dimension + i];
    sum += x * x;
  }
  return std::sqrt(sum);
}

/// Every `parts`-th point from the one at `first` on.
OrbitPoints part_of(const OrbitPoints& points, std::size_t parts, std::size_t first = 0) {
  OrbitPoints result{
      .dimension = points.dimension, .coordinates = {}, .places = {}, .periods = points.periods};
  for (std::size_t j = first; j < points.size(); j += parts) {
    const auto from =
        points.coordinates.begin() + static_cast<std::ptrdiff_t>(j * points.dimension);
    result.coordinates.insert(result.coordinates.end(), from,
                              from + static_cast<std::ptrdiff_t>(points.dimension));
    result.places.push_back(points.places[j]);
  }
  return result;
}

/// From the phase of one point to that of another, the short way.
double turns_between(double number, std::size_t a, std::size_t b) {
  const double turns = number * (static_cast<double>(b) - static_cast<double>(a));
  return turns - std::round(turns);
}

/// The points in the order of the phases number * j.
std::vector<std::size_t> order_by(double number, std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t j) {
    return std::pair(fraction(number * static_cast<double>(j)), j);
  });
  return order;
}

struct Line {
  double length = 0;  ///< of the closed polygon
  double bent = 0;    ///< how far points are off, see kInLine
  double off = 0;     ///< the share of points that are far off, see kOffLine
  double gap = 0;     ///< the widest between phases

  bool is_curve(std::size_t n) const {
    const auto points = static_cast<double>(n);
    return bent < kInLine && off < kMayBeOff && length < kLongestCurve + kLongestStep * points &&
           gap < std::min(kGap, kGapOfPoints / points);
  }
};

Line line_by(const OrbitPoints& points, double number) {
  const std::size_t n = points.size(), d = points.dimension;
  const std::vector<std::size_t> order = order_by(number, n);
  Line line;
  double off = 0, apart = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = order[(k + n - 1) % n], here = order[k], after = order[(k + 1) % n];
    const auto phase = [&](std::size_t j) { return fraction(number * static_cast<double>(j)); };
    const double first = fraction(phase(here) - phase(before)),
                 second = fraction(phase(after) - phase(here));
    const double share = first + second > 0 ? first / (first + second) : 0.5;
    double miss = 0;
    for (std::size_t i = 0; i < d; ++i) {
      const double between = (1 - share) * points.coordinates[before * d + i] +
                             share * points.coordinates[after * d + i];
      miss += std::pow(points.coordinates[here * d + i] - between, 2);
    }
    const double neighbours = distance(points, before, after);
    off += std::sqrt(miss);
    apart += neighbours;
    if (std::sqrt(miss) > kOffLine * neighbours) line.off += 1 / static_cast<double>(n);
    line.gap = std::max(line.gap, second);
    line.length += distance(points, here, after);
  }
  line.bent = apart > 0 ? off / apart : std::numeric_limits<double>::infinity();
  return line;
}

struct Candidate {
  double number = 0, error = 0;
  Line line = {};
};

/// All numbers a multiple of which is `line`, up to whole turns.
void add_candidates(double frequency, double error, std::vector<Candidate>& to) {
  for (std::size_t m = 1; m <= kMostMultiple; ++m)
    for (std::size_t j = 0; j < m; ++j) {
      const auto multiple = static_cast<double>(m);
      to.push_back({(fraction(frequency) + static_cast<double>(j)) / multiple, error / multiple});
    }
}

/// The mean distance from a point to the nearest other one of another phase, by some of the points.
double nearest_distance(const OrbitPoints& points, double number) {
  const std::size_t n = points.size(), looked = std::min(n, kLookedAt);
  double sum = 0;
  for (std::size_t k = 0; k < looked; ++k) {
    const std::size_t a = k * n / looked;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < n; ++b)
      if (std::abs(turns_between(number, a, b)) * static_cast<double>(n) > 0.5)
        nearest = std::min(nearest, distance(points, a, b));
    sum += nearest / static_cast<double>(looked);
  }
  return sum;
}

/// Of those by which the points stand in line, the one of the shortest line.
std::optional<Candidate> best_of(const OrbitPoints& points, std::vector<Candidate> candidates) {
  std::optional<Candidate> best;
  double shortest = std::numeric_limits<double>::infinity();
  for (Candidate& c : candidates) {
    c.line = line_by(points, c.number);
    shortest = std::min(shortest, c.line.length);
    // The same line by two multiples of the number: the one that is known better.
    const auto better = [&](const Candidate& than) {
      return c.line.length < 0.999 * than.line.length ||
             (c.line.length < 1.001 * than.line.length && c.error < than.error);
    };
    if (c.line.is_curve(points.size()) && (!best || better(*best))) best = c;
  }
  if (best && shortest < kShorter * best->line.length) return std::nullopt;
  if (best && best->line.length > kMostApart * static_cast<double>(points.size()) *
                                      nearest_distance(points, best->number))
    return std::nullopt;
  return best;
}

/// The curve that one orbit runs along, if it is one.
std::optional<Candidate> curve_of(const OrbitPoints& points) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < std::min(points.dimension, kSignals); ++i) {
    std::vector<double> signal;
    for (std::size_t j = 0; j < points.size(); ++j)
      signal.push_back(points.coordinates[j * points.dimension + i]);
    for (const SpectralLine& line : spectrum_of(std::span<const double>(signal), kLines).lines)
      if (line.frequency > 0 && line.in_both_halves)
        add_candidates(line.frequency, line.error, candidates);
  }
  return best_of(points, std::move(candidates));
}

/// The length of the cycle that it is, if it is one.
std::optional<std::size_t> cycle_of(const OrbitPoints& points) {
  const std::size_t n = points.size();
  for (std::size_t q = 1; q <= std::min(kLongestCycle, n / 2); ++q) {
    bool returns = true;
    for (std::size_t j = 0; returns && j + q < n; ++j)
      returns = distance(points, j, j + q) < kReturned;
    if (returns) return q;
  }
  return std::nullopt;
}

/// p where the middles of the parts, in the order in which they are visited, stand each p places
/// further about their own middle, or along an angle.
std::optional<std::size_t> steps_about_middle(const OrbitPoints& points, std::size_t parts) {
  if (parts == 1) return 0;
  std::vector<std::array<double, 2>> middles(parts);
  std::array<double, 2> middle{};
  const bool angle = points.periods[0] > 0 || points.periods[1] > 0;
  const std::size_t along = points.periods[0] > 0 ? 0 : 1;
  std::vector<std::complex<double>> turns(parts);
  std::vector<double> counts(parts);
  for (std::size_t j = 0; j < points.places.size(); ++j) {
    const std::size_t k = j % parts;
    counts[k] += 1;
    if (angle)
      turns[k] += std::polar(1., kCircle * points.places[j][along] / points.periods[along]);
    for (std::size_t i = 0; i < 2; ++i) middles[k][i] += points.places[j][i];
  }
  for (std::size_t k = 0; k < parts; ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      middles[k][i] /= counts[k];
      middle[i] += middles[k][i] / static_cast<double>(parts);
    }
  std::vector<std::size_t> order(parts), rank(parts);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t k) {
    return angle ? std::arg(turns[k])
                 : std::atan2(middles[k][1] - middle[1], middles[k][0] - middle[0]);
  });
  for (std::size_t r = 0; r < parts; ++r) rank[order[r]] = r;
  const std::size_t step = (rank[1] + parts - rank[0]) % parts;
  for (std::size_t k = 0; k < parts; ++k)
    if ((rank[(k + 1) % parts] + parts - rank[k]) % parts != step) return std::nullopt;
  return step;
}

/// 1 or -1 where the picture shows in which direction the curve is run through, else 0.
int direction_of(const OrbitPoints& points, double number) {
  const std::vector<std::size_t> order = order_by(number, points.size());
  double area = 0, length = 0;
  std::array<double, 2> place = points.places[order[0]], total{};
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& from = points.places[order[k]];
    const auto& to = points.places[order[(k + 1) % order.size()]];
    std::array<double, 2> way{to[0] - from[0], to[1] - from[1]};
    for (std::size_t i = 0; i < 2; ++i) {
      const double period = points.periods[i];
      if (period > 0) way[i] -= period * std::round(way[i] / period);
      total[i] += way[i];
    }
    area += (place[0] * way[1] - place[1] * way[0]) / 2;
    length += std::hypot(way[0], way[1]);
    for (std::size_t i = 0; i < 2; ++i) place[i] += way[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const double turns = points.periods[i] > 0 ? total[i] / points.periods[i] : 0;
    if (std::abs(turns) > 0.5) return turns > 0 ? 1 : -1;
  }
  // The area of a thin or twice crossed figure is no evidence.
  if (!(std::abs(area) > 1e-3 * length * length)) return 0;
  return area > 0 ? 1 : -1;
}

/// In the direction of the picture.
bool direct(const OrbitPoints& points, double& number) {
  const int direction = direction_of(points, number);
  if (direction < 0) number = fraction(1 - number);
  if (direction == 0) number = std::min(number, 1 - number);
  return direction != 0;
}

/// Whether two parts are on different curves: nowhere as near to each other as neighbours on one.
bool apart(const OrbitPoints& first, const OrbitPoints& second, double number) {
  const std::vector<std::size_t> order = order_by(number, first.size());
  double widest = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    widest = std::max(widest, distance(first, order[k], order[(k + 1) % order.size()]));
  for (std::size_t a = 0; a < first.size(); ++a)
    for (std::size_t b = 0; b < second.size(); ++b) {
      double sum = 0;
      for (std::size_t i = 0; i < first.dimension; ++i)
        sum += std::pow(first.coordinates[a * first.dimension + i] -
                            second.coordinates[b * second.dimension + i],
                        2);
      if (sum < widest * widest / 4) return false;
    }
  return true;
}

Rotation none(std::string reason) {
  return {.kind = Rotation::Kind::none,
          .number = kNoRotation,
          .error = kNoRotation,
          .inner_number = kNoRotation,
          .inner_error = kNoRotation,
          .reason = std::move(reason)};
}

Rotation rotation_on_curve(const OrbitPoints& points, const Candidate& found) {
  const double turns =
      std::min(found.number, 1 - found.number) * static_cast<double>(points.size());
  if (turns < kTurns) return none("it turns so slowly that its points make no five turns");
  if (found.error * static_cast<double>(points.size()) > kWanders)
    return none("its frequency is not the same in the first and in the second half");
  Rotation result{
      .kind = Rotation::Kind::curve, .number = found.number, .error = found.error, .reason = {}};
  result.directed = direct(points, result.number);
  return result;
}

/// \param parts  of them every one is known to be a curve
Rotation rotation_on_islands(const OrbitPoints& points, const OrbitPoints& first,
                             const Candidate& inner, std::size_t parts) {
  // One curve all the same, of which only high multiples of the number are to be seen?
  std::vector<Candidate> candidates;
  for (std::size_t j = 0; j < parts; ++j)
    for (const double sign : {1., -1.})
      candidates.push_back(
          {(fraction(sign * inner.number) + static_cast<double>(j)) / static_cast<double>(parts),
           inner.error / static_cast<double>(parts)});
  if (const auto whole = best_of(points, std::move(candidates)))
    return rotation_on_curve(points, *whole);
  for (std::size_t k = 1; k < parts; ++k)
    if (!apart(first, part_of(points, parts, k), inner.number))
      return none("its points stand in no line along a curve");
  if (std::min(inner.number, 1 - inner.number) * static_cast<double>(first.size()) < kTurns)
    return none(
        fmt::format("it is near a cycle of length {}, and its points make no five turns "
                    "about it",
                    parts));
  if (inner.error * static_cast<double>(first.size()) > kWanders)
    return none("its frequency is not the same in the first and in the second half");
  Rotation result{.kind = Rotation::Kind::islands,
                  .number = kNoRotation,
                  .error = 0,
                  .parts = parts,
                  .inner_number = inner.number,
                  .inner_error = inner.error,
                  .reason = {}};
  if (const auto steps = steps_about_middle(points, parts))
    result.number = static_cast<double>(*steps) / static_cast<double>(parts);
  result.directed = direct(first, result.inner_number);
  return result;
}

}  // namespace

std::string to_string(Rotation::Kind kind) {
  switch (kind) {
    case Rotation::Kind::curve:
      return "curve";
    case Rotation::Kind::islands:
      return "islands";
    case Rotation::Kind::cycle:
      return "cycle";
    case Rotation::Kind::none:
      break;
  }
  return "none";
}

Rotation rotation_of(const OrbitPoints& given) {
  if (given.size() < kFewestReturns)
    return none(fmt::format("{} points are too few: at least {}", given.size(), kFewestReturns));
  const bool finite =
      std::ranges::all_of(given.coordinates, [](double x) { return std::isfinite(x); });
  if (!finite) return none("some of its points are no numbers");
  const OrbitPoints points = scaled(given);
  if (points.dimension == 0)
    return {.kind = Rotation::Kind::cycle,
            .number = 0,
            .parts = 1,
            .inner_number = kNoRotation,
            .reason = {}};
  if (const auto length = cycle_of(points)) {
    const auto steps = steps_about_middle(points, *length);
    return {
        .kind = Rotation::Kind::cycle,
        .number = steps ? static_cast<double>(*steps) / static_cast<double>(*length) : kNoRotation,
        .parts = *length,
        .inner_number = kNoRotation,
        .reason = {}};
  }
  if (const auto found = curve_of(points)) return rotation_on_curve(points, *found);
  for (std::size_t parts = 2; parts <= kMostParts && points.size() / parts >= kFewestReturns;
       ++parts) {
    const OrbitPoints first = part_of(points, parts);
    if (const auto inner = curve_of(first))
      return rotation_on_islands(points, first, *inner, parts);
  }
  return none(
      "its points stand in no line along a curve: it is chaotic, on a torus of more dimensions, or "
      "too short");
}

}  // namespace casimir
