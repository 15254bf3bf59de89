#include "runtime/observer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace casimir {

Observer::Observer(const Module& module, const Settings& settings, const double* parameters,
                   const std::vector<double>& initial)
    : module_(module),
      settings_(settings),
      parameters_(parameters),
      values_(static_cast<std::size_t>(module.functions().invariant_count)),
      sizes_(values_.size()),
      changes_(values_.size()),
      scratch_(initial.size()),
      invariants_(values_.size()) {
  if (!values_.empty())
    module.functions().invariants(0, initial.data(), parameters, values_.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    invariants_[i].initial = invariants_[i].final = values_[i];
    sizes_[i] = std::abs(values_[i]);
  }
  record_sizes(0, initial.data());
  if (settings.sample_every > 0) {
    times_.push_back(0);
    samples_.push_back(initial);
  }
}

bool Observer::needed() const {
  return settings_.monitor || settings_.sample_every > 0 || static_cast<bool>(settings_.give_up) ||
         static_cast<bool>(settings_.progress);
}

void Observer::record_sizes(double t, const double* x) {
  if (!settings_.invariant_sizes || sizes_.empty()) return;
  settings_.invariant_sizes(t, x, values_.data());
  for (std::size_t i = 0; i < sizes_.size(); ++i) sizes_[i] = std::max(sizes_[i], values_[i]);
}

void Observer::record_change(double t, const double* x) {
  if (values_.empty()) return;
  module_.functions().invariants(t, x, parameters_, values_.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double change = std::abs(values_[i] - invariants_[i].initial);
    // A value that overflowed is no small change: it must not be lost in a comparison with NaN.
    changes_[i] = std::isnan(change) ? std::numeric_limits<double>::infinity()
                                     : std::max(changes_[i], change);
    invariants_[i].final = values_[i];
    values_[i] = change;
  }
  if (settings_.invariant_changes) settings_.invariant_changes(t, values_.data());
}

bool Observer::step(double t1, const double* x1,
                    const std::function<void(double t, double* x)>& state_at) {
  if (settings_.monitor) record_change(t1, x1);
  if (settings_.monitor && std::has_single_bit(++steps_)) record_sizes(t1, x1);
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
  if (settings_.progress) settings_.progress(t1);
  return !settings_.give_up || !settings_.give_up();
}

void Observer::finish(Trajectory& trajectory) {
  record_change(trajectory.time, trajectory.state.data());
  record_sizes(trajectory.time, trajectory.state.data());
  for (std::size_t i = 0; i < invariants_.size(); ++i)
    invariants_[i].drift = changes_[i] == 0 ? 0 : changes_[i] / sizes_[i];
  if (settings_.sample_every > 0 && trajectory.time != times_.back()) {
    // A multiple that differs from the end by rounding only is the end.
    const double gap = std::abs(trajectory.time - times_.back());
    if (times_.size() > 1 && gap < 1e-10 * settings_.sample_every) {
      times_.pop_back();
      samples_.pop_back();
    }
    times_.push_back(trajectory.time);
    samples_.push_back(trajectory.state);
  }
  trajectory.invariants = std::move(invariants_);
  trajectory.sample_times = std::move(times_);
  trajectory.samples = std::move(samples_);
}

}  // namespace casimir
