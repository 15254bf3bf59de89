#include "tools/analysis/estimate/parting_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace casimir {
namespace {

/// Of the largest argument in a step: what is zero in double precision.
constexpr double kZeroInDoubles = 1e-10;

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
  const std::optional<double> zero = roots_.zero_in(on_line, kZeroInDoubles);
  if (zero && parts_at(*zero, on_line, duration)) time_ = last_time_ + *zero * duration;
}

/// How fast the arguments change by the rates at a place on the line.
std::vector<double> PartingSolutions::speeds(double part, const RootZeros::StateAt& at,
                                             double time) {
  const std::vector<double> there = roots_.radicands(part, at);
  inputs_.back() = at(part, inputs_.data());
  std::vector<double> rates(last_.size());
  (*rates_)(inputs_.data(), rates.data());
  std::vector<double> result = roots_.radicands(part, [&](double place, double* x) {
    const double now = at(place, x);
    for (std::size_t i = 0; i < rates.size(); ++i) x[i] += time * rates[i];
    return now + time;
  });
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = std::abs((result[k] - there[k]) / time);
  return result;
}

/// Whether the speed of an argument goes to zero with it, and more slowly than it does: that of
/// -sqrt|x| does, that of -x goes as fast as x, and one that crosses has a speed.
bool PartingSolutions::parts_at(double part, const RootZeros::StateAt& at, double duration) {
  constexpr double kFar = 1e-3, kNear = 1e-6, kOfPlace = 1e-3, kSlower = 0.5, kSteeper = 2;
  const double side = part < 1. / 2 ? 1 : -1;
  const std::vector<double> far = speeds(part + side * kFar, at, kOfPlace * kFar * duration);
  const std::vector<double> near = speeds(part + side * kNear, at, kOfPlace * kNear * duration);
  const std::vector<double> there = roots_.radicands(part, at), first = roots_.radicands(0, at),
                            last = roots_.radicands(1, at);
  for (std::size_t k = 0; k < there.size(); ++k)
    if (there[k] <= kZeroInDoubles * std::max(first[k], last[k]) && far[k] > 0 &&
        near[k] <= kSlower * far[k] && near[k] / kNear >= kSteeper * far[k] / kFar)
      return true;
  return false;
}

}  // namespace casimir
