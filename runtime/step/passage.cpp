#include "runtime/step/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kColumns = 6;
constexpr int kMostTrialsOfPassage = 2000;
/// In the place of an error.
constexpr double kNoNumbers = 1e300;
/// By how much small changes of the start may grow, and how large they are.
constexpr double kMostGrowth = 1000, kChange = 1e-9;
/// Local errors relative to the state.
constexpr double kLeastOfPassage = 1e-15;
/// Of the time and of the way, a step in which nothing can happen that rounding does not hide.
constexpr double kLeastOfTime = 64 * kEpsilon, kLeastOfWay = 1e-22;
/// By how much of its size such a step may change the state, and how much of that may be in doubt.
constexpr double kUnmoved = 1e-9, kUnseen = 1e-13;

double largest(const std::vector<double>& x) {
  double size = 0;
  for (const double value : x) size = std::max(size, std::abs(value));
  return size;
}

bool finite(const std::vector<double>& x) {
  return std::ranges::all_of(x, [](double value) { return std::isfinite(value); });
}

}  // namespace

Passage::Passage(Rates rates, const casimir_run& run, std::size_t states)
    : rates_(std::move(rates)), run_(run), states_(states), rate_(states) {}

bool Passage::pass(double& t, double* x, double furthest) {
  const State start(x, x + states_);
  double end = furthest;
  constexpr int kMostCuts = 40;
  for (int cut = 0; cut < kMostCuts; ++cut) {
    State there = start;
    if (end == t || !goes(t, there, end) || !is_the_only_one(t, start, end, there)) return false;
    std::pair<Passage*, const State*> from{this, &start};
    const casimir_step seen = {t,         end,   start.data(), there.data(),
                               &state_at, &from, nullptr,      nullptr};
    if (run_.look) {
      if (const double part = run_.look(run_.looker, &seen); part < 1) {
        end = t + part * (end - t);
        continue;
      }
    }
    if (run_.observe) stopped_ = run_.observe(run_.observer, &seen) != 0;
    std::ranges::copy(there, x);
    t = end;
    return true;
  }
  return false;
}

/// The state within the passage: by another one, up to there.
void Passage::state_at(const casimir_step* step, double t, double* x) {
  const auto& [self, start] = *static_cast<const std::pair<Passage*, const State*>*>(step->data);
  State there = *start;
  if (t != step->t0 && !self->goes(step->t0, there, t))
    there.assign(there.size(), std::numeric_limits<double>::quiet_NaN());
  std::ranges::copy(there, x);
}

/// \return  whether the state could be taken to `end`.
bool Passage::goes(double t, State& x, double end) {
  const double way = end - t;
  rates_(t, x.data(), rate_.data());
  if (!finite(rate_)) return false;
  const double scale = std::max(largest(x), std::abs(way) * largest(rate_));
  State carry(states_);
  double h = way;
  for (int trial = 0; trial < kMostTrialsOfPassage; ++trial) {
    const double rest = end - t;
    const bool last = std::abs(h) >= std::abs(rest);
    const double to = last ? end : t + h;
    const bool least =
        std::abs(to - t) <= std::max(kLeastOfTime * std::abs(t), kLeastOfWay * std::abs(way));
    const double error = attempt(t, x, to);
    constexpr double kOrder = 2 * kColumns - 1;
    const double factor = 0.8 * std::pow(std::max(error, 1e-10), -1 / kOrder);
    h = (to - t) * std::clamp(factor, 0.1, 3.);
    // No step across a kink is good. One that rounding hides does no harm where next to nothing
    // happens in it, as it does at a pole.
    if (!(error <= 1)) {
      if (!least) continue;
      if (!(error < kNoNumbers && moved_ <= kUnmoved * scale && apart_ <= kUnseen * scale))
        return false;
    }
    if (least) h = 3 * (to - t);
    for (std::size_t i = 0; i < states_; ++i) {
      const double more = gain_[i] + carry[i], sum = x[i] + more;
      carry[i] = more - (sum - x[i]);
      x[i] = sum;
    }
    t = to;
    if (last) return true;
  }
  return false;
}

/// \return  the error of the step, 1 = just allowed; kNoNumbers where it has none.
double Passage::attempt(double t, const State& x, double end) {
  moved_ = std::numeric_limits<double>::infinity();
  rates_(t, x.data(), rate_.data());
  ++evaluations_;
  if (!finite(rate_)) return kNoNumbers;
  State rows[kColumns], corner;
  for (int j = 1; j <= kColumns; ++j) {
    State value;
    if (!midpoint(t, x, end, 2 * j, value)) return kNoNumbers;
    for (int k = 1; k < j; ++k) {
      const double ratio = static_cast<double>(j) / (j - k);
      State better(states_);
      for (std::size_t i = 0; i < states_; ++i)
        better[i] = value[i] + (value[i] - rows[k - 1][i]) / (ratio * ratio - 1);
      rows[k - 1] = std::move(value);
      value = std::move(better);
    }
    if (j == kColumns) corner = rows[kColumns - 2];
    rows[j - 1] = std::move(value);
  }
  gain_ = std::move(rows[kColumns - 1]);
  if (!finite(gain_)) return kNoNumbers;
  const double tolerance = std::max(run_.rtol, kLeastOfPassage);
  double error = 0;
  moved_ = largest(gain_);
  apart_ = 0;
  for (std::size_t i = 0; i < states_; ++i) {
    apart_ = std::max(apart_, std::abs(gain_[i] - corner[i]));
    const double size = std::max(std::abs(x[i]), std::abs(x[i] + gain_[i]));
    const double allowed = run_.atol + tolerance * size;
    error = std::max(error, std::abs(gain_[i] - corner[i]) /
                                std::max(allowed, std::numeric_limits<double>::min()));
  }
  return error;
}

/// What the smoothed midpoint rule adds to the state. The last line is Gragg's.
/// \return  whether all rates on the way are numbers.
bool Passage::midpoint(double t, const State& x, double end, int pieces, State& gain) {
  const double h = (end - t) / pieces;
  State before(states_), now(states_), at(states_), rates(states_);
  for (std::size_t i = 0; i < states_; ++i) now[i] = h * rate_[i];
  for (int m = 1; m <= pieces; ++m) {
    for (std::size_t i = 0; i < states_; ++i) at[i] = x[i] + now[i];
    rates_(m == pieces ? end : t + m * h, at.data(), rates.data());
    ++evaluations_;
    if (!finite(rates)) return false;
    if (m == pieces) break;
    for (std::size_t i = 0; i < states_; ++i) before[i] += 2 * h * rates[i];
    std::swap(before, now);
  }
  gain.resize(states_);
  for (std::size_t i = 0; i < states_; ++i) gain[i] = (now[i] + before[i] + h * rates[i]) / 2;
  return true;
}

/// Whether starts beside this one end beside it: where the equations have no derivative, more than
/// one solution may begin, and none of them is the answer.
bool Passage::is_the_only_one(double t, const State& x, double end, const State& there) {
  State rates(states_);
  rates_(t, x.data(), rates.data());
  const double way = std::abs(end - t);
  const double size = std::max(largest(x), way * largest(rates));
  const double change = std::max(kChange * size + 10 * run_.atol, 1e-290);
  for (std::size_t j = 0; j < states_; ++j) {
    for (const double side : {1., -1.}) {
      // Where the motion crosses the place, starts beside it that lie ahead are enough: behind it
      // the equations may have no value.
      if (way * std::abs(rates[j]) > change && side * rates[j] * (end - t) < 0) continue;
      State beside = x;
      beside[j] += side * change;
      if (!goes(t, beside, end)) return false;
      for (std::size_t i = 0; i < states_; ++i)
        if (!(std::abs(beside[i] - there[i]) <= kMostGrowth * change)) return false;
    }
  }
  return true;
}

}  // namespace casimir
