#pragma once

#include <string>
#include <vector>

#include "runtime/integrate.hpp"

namespace casimir {

/// The error of a run beside its time. A time without an error is not reported.
struct Sample {
  std::string method;
  double tolerance = 0;
  double error = 0;    ///< max over the states of |x - reference| / scale
  double drift = 0;    ///< the largest of all invariants
  double seconds = 0;  ///< median of repeated runs of the integration alone, after a warm-up
  double spread = 0;   ///< half the distance of the quartiles of those runs
  unsigned long long steps = 0, evaluations = 0;
  Status status = Status::ok;
};

struct Truth {
  std::vector<double> state;  ///< the reference rounded to double
  std::vector<double> rest;   ///< the reference less `state`
  std::vector<double> scale;  ///< of each state: its size over the run; not zero
};

/// Max over the states of |x - truth| / scale.
double error_of(const std::vector<double>& x, const Truth& truth);

/// One sample: runs until at least `least_seconds` have been spent or `most_runs` made, at least
/// three times.
Sample measure(const Module& module, const Method& method, const Settings& settings,
               const std::vector<double>& initial, const std::vector<double>& parameters,
               const Truth& truth, double least_seconds = 0.05, int most_runs = 200);

}  // namespace casimir
