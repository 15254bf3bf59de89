#include "runtime/step/observer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace casimir {

namespace {

/// Of a value or a size in double: beyond, products lose digits or all of it.
bool in_range(long double a) { return a == 0 || (a > 1e-290L && a < 1e290L); }

long double distance(long double a, long double b) {
  const long double change = std::abs(a - b);
  // A value that overflowed is no small change: it must not be lost in a comparison with NaN.
  return std::isnan(change) ? std::numeric_limits<long double>::infinity() : change;
}

/// Local errors seldom have one sign for long: good methods stay a hundred times below their sum.
constexpr double kMargin = 10;
/// An invariant that has lost this part of its size is not kept, whatever the tolerance.
constexpr long double kLost = 0.05;

}  // namespace

Observer::Observer(const Module& module, const Settings& settings, const double* parameters,
                   const std::vector<double>& initial)
    : module_(module),
      settings_(settings),
      parameters_(parameters),
      values_(static_cast<std::size_t>(module.functions().invariant_count)),
      changes_now_(values_.size()),
      scratch_(initial.size()),
      state_sizes_(initial.size()),
      wide_(values_.size()),
      terms_(values_.size()),
      sizes_(values_.size()),
      changes_(values_.size()),
      local_(values_.size()),
      invariants_(values_.size()) {
  follow_angles(initial);
  record_size(initial.data());
  record_terms(0, initial.data());
  evaluate(0, initial.data());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    invariants_[i].initial = invariants_[i].final = wide_[i];
    sizes_[i] = std::max(sizes_[i], std::abs(wide_[i]));
  }
  if (settings.sample_every > 0) {
    times_.push_back(0);
    samples_.push_back(initial);
  }
}

bool Observer::needed() const {
  return settings_.monitor || settings_.sample_every > 0 || static_cast<bool>(settings_.give_up) ||
         static_cast<bool>(settings_.progress);
}

void Observer::record_size(const double* x) {
  for (std::size_t i = 0; i < state_sizes_.size(); ++i)
    state_sizes_[i] = std::max(state_sizes_[i], std::abs(x[i]));
}

void Observer::follow_angles(const std::vector<double>& initial) {
  if (!settings_.monitor || settings_.invariants == nullptr || values_.empty()) return;
  std::vector<double> parameters;
  if (const int count = module_.functions().parameter_count; count > 0)
    parameters.assign(parameters_, parameters_ + count);
  angles_.emplace(
      *settings_.invariants, std::move(parameters),
      [this](double t, const double* x, double* rates) {
        module_.functions().rhs(t, x, parameters_, rates);
      },
      0, initial);
  if (!angles_->follows()) angles_.reset();
}

/// The invariants, into wide_.
void Observer::evaluate(double t, const double* x) {
  if (values_.empty()) return;
  if (leaves_range_) return evaluate_terms(t, x);
  module_.functions().invariants(t, x, parameters_, values_.data());
  std::copy(values_.begin(), values_.end(), wide_.begin());
  // On the edge of a domain, which errors of a run pass.
  if (settings_.invariant_terms &&
      std::any_of(wide_.begin(), wide_.end(), [](long double v) { return std::isnan(v); }))
    return evaluate_terms(t, x);
  if (angles_) angles_->put(t, x, wide_.data());
}

/// The invariants into wide_ and the sizes of their terms into terms_.
void Observer::evaluate_terms(double t, const double* x) {
  settings_.invariant_terms(t, x, wide_.data(), terms_.data());
  if (angles_) angles_->put(t, x, wide_.data());
}

void Observer::record_terms(double t, const double* x) {
  if (!settings_.invariant_terms || sizes_.empty()) return;
  evaluate_terms(t, x);
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    sizes_[i] = std::max(sizes_[i], std::abs(terms_[i]));
    leaves_range_ = leaves_range_ || !in_range(std::abs(terms_[i]));
  }
  record_local_error(t, x);
}

/// What the local error allowed in each state does to the invariants, to first order.
void Observer::record_local_error(double t, const double* x) {
  const std::size_t n = scratch_.size();
  const std::vector<long double> here = wide_;
  std::vector<long double> local(here.size(), 0);
  std::vector<double> moved(x, x + n);
  for (std::size_t j = 0; j < n; ++j) {
    const double allowed = settings_.atol + settings_.rtol * std::abs(x[j]);
    const double change = std::max(0x1p-20 * std::abs(x[j]), allowed);
    moved[j] = x[j] + change;
    evaluate_terms(t, moved.data());
    moved[j] = x[j];
    for (std::size_t i = 0; i < here.size(); ++i)
      local[i] += std::abs(wide_[i] - here[i]) * (allowed / change);
  }
  for (std::size_t i = 0; i < here.size(); ++i) local_[i] = std::max(local_[i], local[i]);
}

double Observer::allowed_drift(std::size_t i, unsigned long long steps) const {
  if (!settings_.invariant_terms || settings_.fixed_step > 0 || !settings_.monitor)
    return std::numeric_limits<double>::infinity();
  const auto many = static_cast<long double>(steps);
  const long double rounding = (1000 + many) * std::numeric_limits<double>::epsilon();
  const long double tolerance = kMargin * std::max(many, 1.0L) * local_[i];
  return static_cast<double>(
      std::min(rounding + (tolerance == 0 ? 0 : tolerance / sizes_[i]), kLost));
}

void Observer::record_change(double t, const double* x) {
  if (values_.empty()) return;
  evaluate(t, x);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const long double change = distance(wide_[i], invariants_[i].initial);
    changes_[i] = std::max(changes_[i], change);
    invariants_[i].final = wide_[i];
    changes_now_[i] = static_cast<double>(change);
  }
  if (settings_.invariant_changes) settings_.invariant_changes(t, changes_now_.data());
}

bool Observer::step(double t1, const double* x1,
                    const std::function<void(double t, double* x)>& state_at) {
  if (settings_.monitor) {
    record_size(x1);
    if (angles_) angles_->advance(t1, x1, state_at);
    record_change(t1, x1);
    if (settings_.watch) settings_.watch(t1, x1);
    if (settings_.watch_within) settings_.watch_within(t1, x1, state_at);
  }
  if (settings_.monitor && std::has_single_bit(++steps_)) record_terms(t1, x1);
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
  record_size(trajectory.state.data());
  trajectory.sizes = state_sizes_;
  record_change(trajectory.time, trajectory.state.data());
  record_terms(trajectory.time, trajectory.state.data());
  for (std::size_t i = 0; i < invariants_.size(); ++i) {
    // A value that is no number is no drift of 0: those who take the largest would not see it.
    const auto drift = changes_[i] == 0 ? 0 : static_cast<double>(changes_[i] / sizes_[i]);
    invariants_[i].drift = std::isnan(drift) ? std::numeric_limits<double>::infinity() : drift;
    invariants_[i].allowed = allowed_drift(i, trajectory.steps);
  }
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
