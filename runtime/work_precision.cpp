#include "runtime/work_precision.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace casimir {

double error_of(const std::vector<double>& x, const Truth& truth) {
  assert(x.size() == truth.state.size());
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error = std::abs((x[i] - truth.state[i]) - truth.rest[i]) / truth.scale[i];
    if (std::isnan(error)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, error);
  }
  return largest;
}

Sample measure(const Module& module, const Method& method, const Settings& settings,
               const std::vector<double>& initial, const std::vector<double>& parameters,
               const Truth& truth, double least_seconds, int most_runs) {
  Settings watched = settings;
  watched.monitor = true;
  const Trajectory first = integrate(module, method, watched, initial, parameters);
  Sample sample;
  sample.method = method.name;
  sample.tolerance = settings.rtol;
  sample.status = first.status;
  sample.steps = first.steps;
  sample.evaluations = first.evaluations;
  for (const InvariantRecord& record : first.invariants)
    sample.drift = std::max(sample.drift, record.drift);
  // A state at another time than the reference's has no error.
  sample.error = first.status == Status::ok ? error_of(first.state, truth)
                                            : std::numeric_limits<double>::quiet_NaN();

  Settings bare = settings;
  bare.monitor = false;
  bare.sample_every = 0;
  std::vector<double> seconds;
  double spent = 0;
  constexpr int kLeastRuns = 3;
  while (static_cast<int>(seconds.size()) < kLeastRuns ||
         (spent < least_seconds && static_cast<int>(seconds.size()) < most_runs)) {
    seconds.push_back(integrate(module, method, bare, initial, parameters).seconds);
    spent += seconds.back();
    if (settings.give_up && settings.give_up()) break;
  }
  std::sort(seconds.begin(), seconds.end());
  sample.seconds = seconds[seconds.size() / 2];
  sample.spread = (seconds[seconds.size() * 3 / 4] - seconds[seconds.size() / 4]) / 2;
  return sample;
}

}  // namespace casimir
