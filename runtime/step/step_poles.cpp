#include "runtime/step/step_poles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {

StepPoles::StepPoles(const StepWatch& watch, std::size_t states)
    : watch_(watch),
      states_(states),
      evaluate_(watch.rates_and_divisors()),
      inputs_(watch.rates_and_divisors().inputs.size()),
      outputs_(watch.rates_and_divisors().outputs.size()) {}

void StepPoles::begin(const double* parameters) {
  if (parameters)
    std::copy_n(parameters, inputs_.size() - states_ - 1,
                inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
  known_.reset();
}

bool StepPoles::may_lie_between(const double* first, const double* last) const {
  return std::ranges::any_of(watch_.signed_divisors(),
                             [&](std::size_t place) { return first[place] * last[place] < 0; });
}

std::optional<double> StepPoles::first_in(const casimir_step& trial, const double* first,
                                          const double* last) {
  // So short a step cannot be resolved any more: what was found in longer ones holds.
  constexpr double kVisible = 0x1p14 * std::numeric_limits<double>::epsilon();
  const bool resolved = std::abs(trial.t1 - trial.t0) > kVisible * std::abs(trial.t0);
  const std::vector<std::size_t>& places = watch_.signed_divisors();
  std::optional<double> nearest;
  std::optional<std::size_t> whose;
  for (std::size_t which = 0; which < places.size(); ++which) {
    const double value = first[places[which]];
    if (!(value * last[places[which]] < 0)) continue;
    const double zero = zero_in(trial, which, value);
    if (nearest && zero >= *nearest) continue;
    if (!(resolved ? is_pole(trial, which, zero) : known_ == which || is_infinite(trial, which)))
      continue;
    nearest = zero;
    whose = which;
  }
  if (nearest) known_ = whose;
  return nearest;
}

/// The rates and then the divisors.
const double* StepPoles::at(const casimir_step& trial, double part) {
  const double t = part >= 1 ? trial.t1 : trial.t0 + part * (trial.t1 - trial.t0);
  if (part <= 0 || part >= 1)
    std::copy_n(part <= 0 ? trial.x0 : trial.x1, states_, inputs_.begin());
  else
    trial.dense(&trial, t, inputs_.data());
  inputs_.back() = t;
  evaluate_(inputs_.data(), outputs_.data());
  return outputs_.data();
}

/// Where a divisor changes its sign.
double StepPoles::zero_in(const casimir_step& trial, std::size_t which, double first) {
  constexpr int kRounds = 40;
  double before = 0, behind = 1;
  for (int round = 0; round < kRounds; ++round) {
    const double middle = (before + behind) / 2;
    (divisor_at(trial, which, middle) * first > 0 ? before : behind) = middle;
  }
  return behind;
}

/// Whether a rate at the ends of a step that is next to nothing has different signs, and would move
/// the state by far more than its size in the time so far.
bool StepPoles::is_infinite(const casimir_step& trial, std::size_t which) {
  constexpr double kFar = 1e6;
  rates_at(trial, 0, which, before_);
  rates_at(trial, 1, which, behind_);
  const double least = kFar * size_of(trial);
  for (std::size_t i = 0; i < states_; ++i)
    if (before_[i] * behind_[i] < 0 &&
        std::min(std::abs(before_[i]), std::abs(behind_[i])) * std::abs(trial.t0) > least)
      return true;
  return false;
}

/// The largest state at the beginning: what the end of a trial is may be anything.
double StepPoles::size_of(const casimir_step& trial) const {
  double size = 0;
  for (std::size_t i = 0; i < states_; ++i) size = std::max(size, std::abs(trial.x0[i]));
  return size;
}

/// \return  the divisor there.
double StepPoles::rates_at(const casimir_step& trial, double part, std::size_t which,
                           std::vector<double>& rates) {
  const double* const found = at(trial, part);
  rates.assign(found, found + states_);
  return found[states_ + which];
}

/// Whether what a rate is times the divisor stays as large as it is farther away, up to a zero that
/// is no rounding of a quotient whose limit is finite, with rates of different signs on each side.
bool StepPoles::is_pole(const casimir_step& trial, std::size_t which, double zero) {
  constexpr double kFar[] = {1. / 16, 1. / 4, 1}, kNear = 1. / 256, kNearer = 1. / 8;
  const double shorter = std::min(zero, 1 - zero), longer = 1 - shorter;
  const double near = std::min(kNear * longer, shorter);
  if (!(near > 0)) return false;
  const double u = rates_at(trial, zero - near, which, before_);
  const double v = rates_at(trial, zero + near, which, behind_);
  if (!std::isfinite(u + v)) return is_pole_by_ends(trial, which);
  for (const double part : kFar) {
    const double place = zero > 0.5 ? zero - part * longer : zero + part * longer;
    const double w = rates_at(trial, place, which, far_);
    if (std::max(std::abs(u), std::abs(v)) < kNearer * std::abs(w))
      return grows(u, v, w, near * std::abs(trial.t1 - trial.t0), size_of(trial));
  }
  return false;
}

/// The same of a passage that knows its ends alone: one over a pole cannot be taken up to there.
bool StepPoles::is_pole_by_ends(const casimir_step& trial, std::size_t which) {
  constexpr double kNearer = 1. / 8;
  const double u = rates_at(trial, 0, which, before_), v = rates_at(trial, 1, which, behind_);
  const bool begins_near = std::abs(u) < std::abs(v);
  far_ = begins_near ? behind_ : before_;
  return std::min(std::abs(u), std::abs(v)) < kNearer * std::max(std::abs(u), std::abs(v)) &&
         grows(u, v, begins_near ? v : u, std::abs(trial.t1 - trial.t0), size_of(trial));
}

/// \param before,behind,far  the divisor where the rates of these names are
/// \param near  the time from the zero to the nearer ones
/// \param size  of the state
bool StepPoles::grows(double before, double behind, double far, double near, double size) const {
  constexpr double kAsLarge = 1. / 4, kRounding = 1e-14;
  for (std::size_t i = 0; i < states_; ++i) {
    if (!(before_[i] * behind_[i] < 0) || !std::isfinite(before_[i] - behind_[i])) continue;
    const double close = std::min(std::abs(before_[i] * before), std::abs(behind_[i] * behind));
    const double moves = near * std::min(std::abs(before_[i]), std::abs(behind_[i]));
    if (close > kAsLarge * std::abs(far_[i] * far) && moves > kRounding * size) return true;
  }
  return false;
}

}  // namespace casimir
