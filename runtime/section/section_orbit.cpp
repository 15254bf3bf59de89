#include "runtime/section/section_orbit.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {
namespace {

/// A seed is on the plane if the function there is so small beside what a step makes of it.
constexpr double kOnPlane = 1e-9;
/// Values on both sides of the joint of two steps that differ by more are no rounding: there the
/// function is not continuous.
constexpr double kJump = 1e-6;
constexpr double kLargeDeviation = 1e100;

double span_of(const LaneOfStep& step) {
  return std::max({std::abs(step.range.least[step.lane]), std::abs(step.range.largest[step.lane]),
                   std::abs(step.range.first[step.lane])});
}

}  // namespace

double LaneOfStep::state(std::size_t i, double s) const {
  const double* const row = step.rows[i];
  double sum = 0;
  for (int k = step.order; k >= 0; --k) sum = sum * s + row[k * step.lanes + lane];
  return sum;
}

void RunningOrbit::begin(const LaneOfStep& step, const PlaneOfOrbit& plane) {
  const double first = step.range.first[step.lane];
  if (plane.period > 0) shift_ = -plane.period * std::round(first / plane.period);
  const double here = first + shift_;
  const double slope = step.coefficient(1) * (step.taken() < 0 ? -1 : 1);
  const double span = plane.period > 0 ? plane.period : span_of(step);
  cell_ = (std::abs(here) <= kOnPlane * span ? slope > 0 : here > 0) ? 0 : -1;
  last_ = here;
  begun_ = true;
}

void RunningOrbit::join(const LaneOfStep& step, const PlaneOfOrbit& plane) {
  const double first = step.range.first[step.lane];
  if (plane.period > 0) {
    shift_ += plane.period * std::round((last_ - (first + shift_)) / plane.period);
  } else if (std::abs(first - last_) > kJump * span_of(step)) {
    cell_ = first > 0 ? 0 : -1;
    doubt();
  }
}

std::vector<PolynomialRoot> RunningOrbit::passages_in(const LaneOfStep& step,
                                                      const PlaneOfOrbit& plane) const {
  const double least = step.range.least[step.lane] + shift_,
               largest = step.range.largest[step.lane] + shift_;
  std::vector<PolynomialRoot> all;
  const auto add_level = [&](long long level, double value) {
    const bool above = cell_ >= level;
    if (above ? least > value : largest < value) return;
    std::vector<double> c;
    for (int k = 0; k <= step.step.order; ++k) c.push_back(step.coefficient(k));
    c[0] += shift_ - value;
    for (const PolynomialRoot& passage : passages(c, step.taken(), above))
      if (passage.rising == plane.upwards)
        all.push_back({exact_place(step, plane, passage.at, value), passage.rising});
  };
  if (!(plane.period > 0)) {
    add_level(0, 0);
    return all;
  }
  const auto from = static_cast<long long>(std::floor(least / plane.period)),
             to = static_cast<long long>(std::ceil(largest / plane.period));
  for (long long level = from; level <= to; ++level)
    add_level(level, static_cast<double>(level) * plane.period);
  std::ranges::sort(all, {}, &PolynomialRoot::at);
  return all;
}

double RunningOrbit::off_plane(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                               double value) const {
  std::vector<double> x, values;
  for (std::size_t i = 0; i < plane.states; ++i) x.push_back(step.state(i, at));
  const double off = value_of(plane.function, x.data(), values) + shift_ - value;
  return plane.period > 0 ? off - plane.period * std::round(off / plane.period) : off;
}

/// By bisection, from the nearest places around on which the function has different signs. Rounding
/// moves a multiple zero of the series far from that of the function, whose sign at a state is
/// known better.
double RunningOrbit::place_of_sign(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                                   double value) const {
  constexpr double kNearest = 1e-9, kWider = 4, kEqual = 1e-15;
  const double length = std::abs(step.taken());
  const double least = std::min(0., step.taken()), most = std::max(0., step.taken());
  for (double aside = kNearest * length; aside < length; aside *= kWider) {
    double before = std::max(at - aside, least), behind = std::min(at + aside, most);
    const double first = off_plane(step, plane, before, value);
    if (!(first * off_plane(step, plane, behind, value) < 0)) continue;
    while (behind - before > kEqual * length) {
      const double middle = (before + behind) / 2;
      if (!(middle > before && middle < behind)) break;
      (off_plane(step, plane, middle, value) * first > 0 ? before : behind) = middle;
    }
    return behind;
  }
  return at;
}

double RunningOrbit::exact_place(const LaneOfStep& step, const PlaneOfOrbit& plane, double at,
                                 double value) const {
  for (int round = 0; round < 2; ++round) {
    double slope = 0;
    for (int k = step.step.order; k > 0; --k) slope = slope * at + k * step.coefficient(k);
    const double next = at - off_plane(step, plane, at, value) / slope;
    // Where it only just passes, Newton's step says nothing.
    constexpr double kSmall = 1e-6;
    const double change = std::abs(next - at) / std::abs(step.taken());
    if (!(change <= kSmall)) {
      at = place_of_sign(step, plane, at, value);
      break;
    }
    at = next;
    if (change < 1e-12) break;  // the next one is rounding
  }
  const double end = step.taken();
  return std::clamp(at, std::min(0., end), std::max(0., end));
}

double RunningOrbit::size_of_deviation(const double* deviation,
                                       const SectionSettings& settings) const {
  double sum = 0;
  for (std::size_t i = 0; i < settings.states; ++i) sum += deviation[i] * deviation[i];
  return std::sqrt(sum);
}

void RunningOrbit::record(const LaneOfStep& step, double at, const SectionSettings& settings) {
  const casimir_lane_step& all = step.step;
  result_.times.push_back(offset_ + (all.t[step.lane] + at * all.unit[step.lane]));
  const std::size_t kept = settings.keep_deviations ? start_.size() : settings.states;
  for (std::size_t i = 0; i < kept; ++i) result_.states.push_back(step.state(i, at));
  if (settings.keep_deviations || start_.size() == settings.states) return;
  std::vector<double> deviation;
  for (std::size_t i = settings.states; i < start_.size(); ++i)
    deviation.push_back(step.state(i, at));
  result_.growth.push_back(log_growth_ + std::log(size_of_deviation(deviation.data(), settings)));
}

bool RunningOrbit::gone(const SectionSettings& settings) {
  if (since_ > settings.steps_between) result_.returns = false;
  return !result_.returns;
}

bool RunningOrbit::see(const LaneOfStep& step, const PlaneOfOrbit& plane,
                       const SectionSettings& settings) {
  ++since_;
  if (!std::isfinite(step.range.last[step.lane])) {
    begun_ = false;  // the function has no values here
    doubt();
    return gone(settings);
  }
  if (begun_)
    join(step, plane);
  else
    begin(step, plane);
  for (const PolynomialRoot& passage : passages_in(step, plane)) {
    if (result_.size() == settings.points) break;
    record(step, passage.at, settings);
    since_ = 0;
  }
  last_ = step.range.last[step.lane] + shift_;
  if (plane.period > 0)
    cell_ = static_cast<long long>(std::floor(last_ / plane.period));
  else if (last_ != 0)
    cell_ = last_ > 0 ? 0 : -1;
  if (result_.size() == settings.points) return true;
  if (gone(settings)) return true;
  if (settings.keep_deviations || start_.size() == settings.states) return false;
  double largest = 0;
  for (std::size_t i = settings.states; i < start_.size(); ++i)
    largest = std::max(largest, std::abs(step.step.rows[i][step.lane]));
  goes_on_ = largest > kLargeDeviation;
  return goes_on_;
}

bool RunningOrbit::leave(const double* x, const casimir_outcome& outcome,
                         const SectionSettings& settings) {
  offset_ += outcome.t;
  result_.steps += outcome.steps;
  result_.time = offset_;
  result_.state.assign(x, x + settings.states);
  start_.assign(x, x + start_.size());
  if (goes_on_ && outcome.status == CASIMIR_STOPPED) {
    goes_on_ = false;
    const double size = size_of_deviation(x + settings.states, settings);
    log_growth_ += std::log(size);
    for (std::size_t i = settings.states; i < start_.size(); ++i) start_[i] /= size;
    return true;
  }
  const bool complete = result_.size() == settings.points;
  result_.status = complete ? Status::ok : status_of(outcome.status);
  return false;
}

}  // namespace casimir
