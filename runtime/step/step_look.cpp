#include "runtime/step/step_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/step/between_places.hpp"

namespace casimir {
namespace {

/// By how much an exponent may change from one place to the next: a series of order 24 resolves
/// several times as much in one step.
constexpr double kResolved = 8;
/// e to this power is nothing.
constexpr double kNegligible = -80;
/// The same for powers, beside the largest that was seen.
constexpr double kNegligiblePower = -40, kLeastPower = -60;
/// By how much the argument of an oscillation may change in a step.
constexpr double kTurn = 2;
constexpr double kShorter = 0.4;

/// The next of numbers between 0 and 1 that no motion follows.
double next(double shift) {
  constexpr double kGoldenSection = 0.6180339887498949;
  return shift + kGoldenSection - (shift + kGoldenSection >= 1 ? 1 : 0);
}

double in_the_middle(double shift) { return 0.3 + 0.4 * shift; }

bool is_exponent(const StepWatch::Watched& watched) {
  using Kind = StepWatch::Kind;
  return watched.kind == Kind::exponent || watched.kind == Kind::both ||
         watched.kind == Kind::front;
}

}  // namespace

StepLook::StepLook(const StepWatch& watch, std::size_t states, const double* parameters,
                   const double* state)
    : watch_(watch),
      states_(states),
      inputs_(watch.arguments().inputs.size()),
      middle_(watch.arguments().outputs.size()),
      aside_(middle_.size()) {
  if (!watch.compiled()) evaluate_.emplace(watch.arguments());
  for (End& end : ends_) {
    end.x.resize(states);
    end.values.resize(middle_.size());
  }
  for (std::vector<double>& values : sampled_) values.resize(middle_.size());
  begin(parameters, state);
}

void StepLook::begin(const double* parameters, const double* state) {
  const bool all = watch_.is_extreme(parameters, state);
  watched_.clear();
  met_ = nullptr;
  for (const StepWatch::Watched& watched : watch_.watched())
    if (all || !watched.faint) watched_.push_back(watched);
  parameters_ = parameters;
  if (parameters)
    std::copy_n(parameters, inputs_.size() - states_ - 1,
                inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
  negligible_ = kNegligible - watch_.log_of_factors();
  for (std::size_t i = states_; i + 1 < inputs_.size(); ++i)
    negligible_ -= std::log(std::max(std::abs(inputs_[i]), 1.));
  highest_.assign(watched_.size(), -std::numeric_limits<double>::infinity());
  for (End& end : ends_) end.known = false;
  jump_.reset();
  shift_ = 0.5;
  quiet_for_ = 0;
  chatter_ = Chatter();
  at_pole_ = false;
  if (poles_) poles_->begin(parameters);
}

void StepLook::end_before_poles() {
  if (watch_.signed_divisors().empty()) return;
  poles_.emplace(watch_, states_);
  poles_->begin(parameters_);
}

void StepLook::arguments(double t, const double* x, double* values) {
  if (StepWatch::Values* const compiled = watch_.compiled())
    return compiled(t, x, parameters_, values);
  if (x != inputs_.data()) std::copy_n(x, states_, inputs_.begin());
  inputs_.back() = t;
  (*evaluate_)(inputs_.data(), values);
}

/// \param exactly  by the dense output, though cubic interpolation may be to be had, which costs a
///                 Runge-Kutta method less.
void StepLook::arguments_within(const casimir_step& trial, double part, bool exactly,
                                double* values) {
  if (part <= 0) return arguments(trial.t0, trial.x0, values);
  if (part >= 1) return arguments(trial.t1, trial.x1, values);
  const double h = trial.t1 - trial.t0, t = trial.t0 + part * h;
  double* const x = inputs_.data();
  if (trial.f0 && trial.f1 && !exactly) {
    const double rest = 1 - part;
    const double a0 = rest * rest * (1 + 2 * part), a1 = part * part * (1 + 2 * rest);
    const double b0 = h * part * rest * rest, b1 = -h * part * part * rest;
    for (std::size_t i = 0; i < states_; ++i)
      x[i] = a0 * trial.x0[i] + a1 * trial.x1[i] + b0 * trial.f0[i] + b1 * trial.f1[i];
  } else {
    trial.dense(&trial, t, x);
  }
  arguments(t, x, values);
}

void StepLook::take(End& end, double t, const double* x) {
  const std::size_t bytes = states_ * sizeof(double);
  if (end.known && end.t == t && std::memcmp(end.x.data(), x, bytes) == 0) return;
  arguments(t, x, end.values.data());
  end.known = true;
  end.t = t;
  std::memcpy(end.x.data(), x, bytes);
}

double StepLook::place_within() const { return in_the_middle(next(shift_)); }

void StepLook::sample(const casimir_step& trial) {
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double between = (static_cast<double>(i) - 0.75 + 0.5 * shift_) / (kPlaces - 2);
    places_[i] = i == 0 ? 0 : i + 1 == kPlaces ? 1 : between;
    if (i == 0 || i + 1 == kPlaces)
      sampled_[i] = i == 0 ? first().values : last().values;
    else
      arguments_within(trial, places_[i], false, sampled_[i].data());
  }
}

/// An argument at all the places.
StepLook::Values StepLook::sampled_at(const StepWatch::Watched& watched) const {
  Values values;
  for (std::size_t i = 0; i < kPlaces; ++i) values[i] = sampled_[i][watched.place];
  return values;
}

bool StepLook::is_quiet(const casimir_step& trial) {
  // Then it changes by six tenths of itself at most.
  constexpr double kLonger = 6;
  const double h = std::abs(trial.t1 - trial.t0);
  met_ = nullptr;
  take_ends(trial);
  if (may_go_over_pole()) return false;
  if (watched_.empty()) return true;
  const bool follows = trial.t0 == quiet_until_ && h <= kLonger * quiet_for_ && !jump_;
  quiet_for_ = 0;
  for (const StepWatch::Watched& watched : watched_)
    if (!hardly_changes(watched)) return false;
  quiet_for_ = h;
  quiet_until_ = trial.t1;
  return follows;
}

/// From the beginning to the end.
bool StepLook::hardly_changes(const StepWatch::Watched& watched) const {
  constexpr double kHardly = 0.1, kHardlyMore = 1;
  const double u = first().values[watched.place], v = last().values[watched.place];
  const double change = std::abs(v - u), least = std::min(std::abs(u), std::abs(v));
  switch (watched.kind) {
    case StepWatch::Kind::unit:
      return change < kHardly * (1 - std::max(std::abs(u), std::abs(v)));
    case StepWatch::Kind::exponent:
      return change < kHardlyMore;
    case StepWatch::Kind::phase:
      return change < kHardly;
    case StepWatch::Kind::power:
    case StepWatch::Kind::divisor:
      return change * watched.exponent < kHardlyMore * least && change < kHardly * least;
    default:
      return change < kHardly * least;
  }
}

/// Whether the ends and one place between them show that nothing is near.
bool StepLook::is_calm(const casimir_step& trial, double part, const double* middle) {
  if (middle)
    arguments(trial.t0 + part * (trial.t1 - trial.t0), middle, middle_.data());
  else
    arguments_within(trial, part, false, middle_.data());
  bool all = true, may_turn = false;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const StepWatch::Watched& watched = watched_[i];
    all = is_calm(watched, i) && all;
    if (!is_exponent(watched)) continue;
    const auto [least, most] = range_of(watched);
    may_turn = may_turn || std::max(-least, most) > kResolved;
  }
  return all && !(may_turn && turns(trial));
}

/// Between the least and the largest of an argument at the ends of a step and the place between.
std::pair<double, double> StepLook::range_of(const StepWatch::Watched& watched) const {
  const double u = first().values[watched.place], v = middle_[watched.place],
               w = last().values[watched.place];
  return {std::min(std::min(u, v), w), std::max(std::max(u, v), w)};
}

/// Whether an exponent leaves the beginning so fast that it may have been somewhere else between
/// the places at which it is much the same: beyond a peak, or two.
bool StepLook::turns(const casimir_step& trial) {
  constexpr double kAside = 0x1p-7, kTimes = 4;
  arguments_within(trial, kAside, false, aside_.data());
  for (const StepWatch::Watched& watched : watched_) {
    if (!is_exponent(watched)) continue;
    const auto [least, most] = range_of(watched);
    const std::size_t place = watched.place;
    const double slope = std::abs(aside_[place] - first().values[place]) / kAside;
    if (!(slope < kTimes * (most - least) + kResolved)) return true;
  }
  return false;
}

bool StepLook::is_calm(const StepWatch::Watched& watched, std::size_t which) {
  const auto [least, most] = range_of(watched);
  // No number, or infinities of both signs.
  const std::size_t place = watched.place;
  const double sum = first().values[place] + middle_[place] + last().values[place];
  if (std::isnan(sum)) return false;
  const double change = most - least;
  // Of one that turns on the way: a motion that sets out slowly may be as far on the other side of
  // a peak at the end, and about as far before it at the place between.
  const double swing = std::abs(middle_[place] - first().values[place]) +
                       std::abs(last().values[place] - middle_[place]);
  switch (watched.kind) {
    case StepWatch::Kind::unit:
      return std::max(std::abs(least), std::abs(most)) + change < 1;
    case StepWatch::Kind::exponent:
      return swing < kResolved || most + 2 * swing < negligible_ || least - swing > beyond_;
    case StepWatch::Kind::both:
      return swing < kResolved || std::max(least, -most) - swing > beyond_;
    case StepWatch::Kind::power: {
      const double largest = std::max(std::abs(least), std::abs(most));
      const double below = largest - swing;
      highest_[which] = std::max(highest_[which], watched.exponent * std::log(largest));
      return (below > 0 && watched.exponent * std::log(largest / below) < kResolved) ||
             watched.exponent * std::log(largest + swing) < highest_[which] + kNegligiblePower;
    }
    case StepWatch::Kind::front:
      return 2 * swing < kResolved ||
             2 * (2 * swing - std::min(std::abs(least), std::abs(most))) < negligible_;
    case StepWatch::Kind::phase:
      return change < kTurn;
    case StepWatch::Kind::divisor: {
      const double near = std::min(std::abs(least), std::abs(most));
      if (!(least * most > 0 && change < near)) return false;
      // log(1 + a) <= a
      return watched.exponent * change < kResolved * near ||
             watched.exponent * std::log1p(change / near) < kResolved;
    }
    default:
      return change < std::min(std::abs(least), std::abs(most));
  }
}

/// Whether something that is divided by changes its sign in a step.
bool StepLook::passes_pole() const {
  return std::ranges::any_of(watched_, [&](const StepWatch::Watched& watched) {
    return watched.kind == StepWatch::Kind::divisor &&
           first().values[watched.place] * last().values[watched.place] < 0;
  });
}

bool StepLook::may_go_over_pole() const {
  return poles_ && poles_->may_lie_between(first().values.data(), last().values.data());
}

/// What may be tried of a step that goes over a pole.
std::optional<double> StepLook::up_to_pole(const casimir_step& trial) {
  constexpr double kOfTheWay = 0.7;
  if (!may_go_over_pole()) return std::nullopt;
  const auto part = poles_->first_in(trial, first().values.data(), last().values.data());
  if (!part) return std::nullopt;
  const double least = 64 * std::numeric_limits<double>::epsilon() * std::abs(trial.t0);
  at_pole_ = *part * std::abs(trial.t1 - trial.t0) <= least;
  return at_pole_ ? 0 : kOfTheWay * *part;
}

double StepLook::within(const casimir_step& trial, const double* middle) {
  if (const auto part = up_to_pole(trial)) {
    met_ = nullptr;
    jump_.reset();
    return *part;
  }
  if (watched_.empty()) return 1;
  if (chatter_.goes_on(trial.t0)) return 0;
  const double h = std::abs(trial.t1 - trial.t0);
  const double least = 64 * std::numeric_limits<double>::epsilon() * std::abs(trial.t0);
  if (h <= least) return ends_at_poles_ && passes_pole() ? 0 : 1;
  shift_ = next(shift_);
  met_ = nullptr;
  if (is_calm(trial, in_the_middle(shift_), middle)) return ends_behind_jump(trial) ? 2 : 1;
  sample(trial);
  double part = 1;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const StepWatch::Watched& watched = watched_[i];
    double own = 1;
    switch (watched.kind) {
      case StepWatch::Kind::side:
      case StepWatch::Kind::jump:
      case StepWatch::Kind::turn:
        own = up_to_branch(trial, watched);
        break;
      case StepWatch::Kind::positive:
      case StepWatch::Kind::unit:
        own = defined(trial, watched);
        break;
      case StepWatch::Kind::exponent:
      case StepWatch::Kind::both:
      case StepWatch::Kind::front:
        own = resolved(watched, i);
        break;
      case StepWatch::Kind::power:
        own = resolved_power(watched, i);
        break;
      case StepWatch::Kind::divisor:
        own = std::min(up_to_dip(watched), resolved(watched, i));
        break;
      case StepWatch::Kind::phase:
        own = part_of_turn(watched);
        break;
    }
    if (!(own < part)) continue;
    part = own;
    const bool branches = watched.kind == StepWatch::Kind::side ||
                          watched.kind == StepWatch::Kind::jump ||
                          watched.kind == StepWatch::Kind::turn;
    met_ = branches ? &watched : nullptr;
  }
  if (part == 1) return ends_behind_jump(trial) ? 2 : 1;
  if (met_) chatter_.cut();
  part = std::max(part, std::min(0.9, least / h));
  jump_ = met_ && met_->kind != StepWatch::Kind::side
              ? std::optional(trial.t0 + part * (trial.t1 - trial.t0))
              : std::nullopt;
  return part;
}

/// As it was cut to do when it was longer.
bool StepLook::ends_behind_jump(const casimir_step& trial) const {
  constexpr double kSame = 8 * std::numeric_limits<double>::epsilon();
  return jump_ && std::abs(trial.t1 - *jump_) <= kSame * (std::abs(*jump_) + std::abs(trial.t0));
}

/// Between two places a base is not larger than at these by more than it changes from place to
/// place around them. Its logarithm would not do: it changes by any amount where the base passes
/// zero, and there the power is nothing.
double StepLook::resolved_power(const StepWatch::Watched& watched, std::size_t which) {
  const Values b = sampled_at(watched);
  if (!std::ranges::all_of(b, [](double value) { return std::isfinite(value); })) return 1;
  const auto power = [&](double base) { return watched.exponent * std::log(base); };
  double& highest = highest_[which];
  for (const double value : b) highest = std::max(highest, power(std::abs(value)));
  for (std::size_t i = 0; i + 1 < kPlaces; ++i) {
    const double most = reach(places_, b, i);
    const double size = std::max(std::abs(b[i]), std::abs(b[i + 1]));
    const double seen = std::max(power(size), highest + kLeastPower), above = power(size + most);
    if (above > highest + kNegligiblePower && above - seen > kResolved) return kShorter;
  }
  return 1;
}

/// Between two places the exponent is not above the larger of its values there by more than it
/// changes from place to place around them.
double StepLook::resolved(const StepWatch::Watched& watched, std::size_t which) {
  using Kind = StepWatch::Kind;
  const bool is_divisor = watched.kind == Kind::divisor;
  const double times = watched.kind == Kind::front ? 2 : 1;
  Values u = sampled_at(watched);
  for (double& value : u) {
    value = is_divisor ? -watched.exponent * std::log(std::abs(value)) : times * value;
    if (std::isnan(value) || value == std::numeric_limits<double>::infinity()) return 1;
  }
  double negligible = negligible_;
  if (is_divisor) {
    double& highest = highest_[which];
    highest = std::max(highest, *std::ranges::max_element(u));
    if (std::isinf(highest)) return 1;
    negligible = highest + kNegligiblePower;
    for (double& value : u) value = std::max(value, highest + kLeastPower);
  }
  const Values before = u;
  // The exponents of what is to be resolved are not above these.
  if (watched.kind == Kind::front || watched.kind == Kind::both)
    for (double& value : u) value = watched.kind == Kind::both ? std::abs(value) : -std::abs(value);
  for (std::size_t i = 0; i + 1 < kPlaces; ++i) {
    const double most = reach(places_, before, i);
    const bool beyond = !is_divisor && std::min(u[i], u[i + 1]) - most > beyond_;
    if (most > kResolved && std::max(u[i], u[i + 1]) + most > negligible && !beyond)
      return kShorter;
  }
  return 1;
}

/// What is divided by is about that parabola through three places which comes nearest to zero: a
/// quotient that becomes far larger than at these places is not resolved.
double StepLook::up_to_dip(const StepWatch::Watched& watched) const {
  const Values u = sampled_at(watched);
  for (std::size_t i = 0; i + 1 < kPlaces; ++i)
    if (u[i] * u[i + 1] < 0) return kShorter;
  for (std::size_t i = 0; i + 2 < kPlaces; ++i) {
    const auto dip = dip_at(places_, u, i);
    if (!dip) continue;
    const double near = std::min({std::abs(u[i]), std::abs(u[i + 1]), std::abs(u[i + 2])});
    const bool vanishes = !(dip->value * u[i + 1] > 0);
    if (vanishes || watched.exponent * std::log(near / std::abs(dip->value)) > kResolved)
      return kShorter;
  }
  return 1;
}

double StepLook::part_of_turn(const StepWatch::Watched& watched) const {
  constexpr double kLeast = 1e-3;
  const Values u = sampled_at(watched);
  const auto [least, most] = std::ranges::minmax(u);
  const double change = most - least;
  return change < kTurn ? 1 : std::max(0.9 * kTurn / change, kLeast);
}

double StepLook::defined(const casimir_step& trial, const StepWatch::Watched& watched) {
  const auto is_defined = [&](double u) {
    return watched.kind == StepWatch::Kind::unit ? std::abs(u) <= 1 : u >= 0;
  };
  for (std::size_t i = 1; i + 1 < kPlaces; ++i) {
    if (!is_defined(sampled_[i][watched.place]) && !is_defined(value(trial, watched, places_[i])))
      return kShorter;
  }
  return 1;
}

}  // namespace casimir
