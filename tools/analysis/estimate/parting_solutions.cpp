#include "tools/analysis/estimate/parting_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace casimir {
namespace {

/// Of the largest argument in a step: what is zero in double precision.
constexpr double kZeroInDoubles = 1e-10;
/// Of the fastest change of an argument so far: where it comes to zero, what is none.
constexpr double kAtRest = 1e-3;

}  // namespace

PartingSolutions::PartingSolutions(const PreparedScene& run)
    : roots_(run.specialisation.rhs, run.parameters), last_(run.initial), inputs_(run.initial) {
  if (!roots_.any()) return;
  rates_.emplace(run.specialisation.rhs);
  inputs_.insert(inputs_.end(), run.parameters.begin(), run.parameters.end());
  inputs_.push_back(0);
}

void PartingSolutions::watch(Settings& settings) {
  if (!roots_.any()) return;
  last_time_ = settings.begin;
  time_.reset();
  settings.watch_within = [this, before = settings.watch_within](double t, const double* x,
                                                                 const auto& state_at) {
    if (before) before(t, x, state_at);
    if (!time_ && t != last_time_) see(t, x);
    last_.assign(x, x + last_.size());
    last_time_ = t;
  };
}

/// A step that passes the place: on the line between its ends an argument comes to zero, whatever
/// the formula of the step makes of it between them.
void PartingSolutions::see(double t, const double* x) {
  const double duration = t - last_time_;
  const RootZeros::StateAt on_line = [&](double part, double* state) {
    for (std::size_t i = 0; i < last_.size(); ++i) state[i] = (1 - part) * last_[i] + part * x[i];
    return last_time_ + part * duration;
  };
  const std::vector<double> first = roots_.radicands(0, on_line);
  const std::vector<double> last = roots_.radicands(1, on_line);
  fastest_.resize(first.size());
  for (std::size_t k = 0; k < first.size(); ++k)
    fastest_[k] = std::max(fastest_[k], std::abs((last[k] - first[k]) / duration));
  const std::optional<double> zero = roots_.zero_in(on_line, kZeroInDoubles);
  if (zero && rests_at(*zero, on_line, duration)) time_ = last_time_ + *zero * duration;
}

/// Whether an argument that is zero there stays so, as the rates have it.
bool PartingSolutions::rests_at(double part, const RootZeros::StateAt& at, double duration) {
  constexpr double kAside = 1e-3;
  const std::vector<double> there = roots_.radicands(part, at);
  inputs_.back() = at(part, inputs_.data());
  std::vector<double> rates(last_.size());
  (*rates_)(inputs_.data(), rates.data());
  const std::vector<double> moved = roots_.radicands(part, [&](double place, double* x) {
    const double time = at(place, x);
    for (std::size_t i = 0; i < rates.size(); ++i) x[i] += kAside * duration * rates[i];
    return time + kAside * duration;
  });
  const std::vector<double> first = roots_.radicands(0, at), last = roots_.radicands(1, at);
  for (std::size_t k = 0; k < there.size(); ++k) {
    const bool zero = there[k] <= kZeroInDoubles * std::max(first[k], last[k]);
    const double speed = std::abs((moved[k] - there[k]) / (kAside * duration));
    if (zero && speed <= kAtRest * fastest_[k]) return true;
  }
  return false;
}

}  // namespace casimir
