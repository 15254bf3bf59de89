#include "runtime/observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace casimir {

Observer::Observer(const Module& module, const Settings& settings, const double* parameters, const std::vector<double>& initial)
    : module_(module),
      settings_(settings),
      parameters_(parameters),
      initial_invariants_(static_cast<std::size_t>(module.functions().invariant_count)),
      values_(initial_invariants_.size()),
      scratch_(initial.size()),
      invariants_(initial_invariants_.size()) {
  module.functions().invariants(0, initial.data(), parameters, initial_invariants_.data());
  for (std::size_t i = 0; i < invariants_.size(); ++i) invariants_[i].initial = invariants_[i].final = initial_invariants_[i];
  if (settings.sample_every > 0) {
    times_.push_back(0);
    samples_.push_back(initial);
  }
}

bool Observer::needed() const {
  return settings_.monitor || settings_.sample_every > 0 || static_cast<bool>(settings_.give_up);
}

void Observer::record_drift(double t, const double* x) {
  module_.functions().invariants(t, x, parameters_, values_.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    InvariantRecord& record = invariants_[i];
    double scale = std::abs(record.initial);
    if (i < settings_.invariant_scales.size()) scale = std::max(scale, settings_.invariant_scales[i]);
    const double change = std::abs(values_[i] - record.initial);
    const double drift = change == 0 ? 0 : change / scale;
    // A value that overflowed is no small drift: it must not be lost in a comparison with NaN.
    record.drift = std::isnan(drift) ? std::numeric_limits<double>::infinity() : std::max(record.drift, drift);
    record.final = values_[i];
  }
}

bool Observer::step(double t1, const double* x1, const std::function<void(double t, double* x)>& state_at) {
  if (settings_.monitor) record_drift(t1, x1);
  if (settings_.sample_every > 0) {
    const double direction = settings_.duration < 0 ? -1 : 1;
    for (;; ++next_sample_) {
      const double time = direction * static_cast<double>(next_sample_) * settings_.sample_every;
      if (direction * (time - t1) > 0 || direction * (time - settings_.duration) >= 0) break;
      state_at(time, scratch_.data());
      times_.push_back(time);
      samples_.push_back(scratch_);
    }
  }
  return !settings_.give_up || !settings_.give_up();
}

void Observer::finish(Trajectory& trajectory) {
  if (!settings_.monitor) record_drift(trajectory.time, trajectory.state.data());
  if (settings_.sample_every > 0 && trajectory.time != times_.back()) {
    times_.push_back(trajectory.time);
    samples_.push_back(trajectory.state);
  }
  trajectory.invariants = std::move(invariants_);
  trajectory.sample_times = std::move(times_);
  trajectory.samples = std::move(samples_);
}

}  // namespace casimir
