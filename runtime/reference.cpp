#include "runtime/reference.hpp"

#include <cln/float_io.h>
#include <cln/real.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/taylor_jet.hpp"

namespace casimir {
namespace {

constexpr double kLog2Of10 = 3.321928094887362;
constexpr int kGuardDigits = 6;
constexpr unsigned long kMaxSteps = 2000000;

double log2_of(const cln::cl_F& x) {
  if (cln::zerop(x)) return -std::numeric_limits<double>::infinity();
  const cln::decoded_float parts = cln::decode_float(x);
  return static_cast<double>(cln::cl_I_to_long(parts.exponent)) +
         std::log2(cln::double_approx(parts.mantissa));
}

/// 2^e for a double e of any size.
cln::cl_F power_of_two(double e, const Arithmetic<cln::cl_F>& arithmetic) {
  const double whole = std::floor(e);
  return cln::scale_float(arithmetic.from(cln::rational(cln::cl_DF(std::exp2(e - whole)))),
                          cln::cl_I(static_cast<long>(whole)));
}

/// The step from the last two coefficients: the first terms left out are about as large as the
/// tolerance times the state.
double log2_step(const std::vector<std::vector<cln::cl_F>>& series, double log2_tolerance) {
  double size = -std::numeric_limits<double>::infinity();
  for (const auto& s : series) size = std::max(size, log2_of(s[0]));
  const std::size_t order = series[0].size() - 1;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = order - 1; k <= order; ++k) {
    double last = -std::numeric_limits<double>::infinity();
    for (const auto& s : series) last = std::max(last, log2_of(s[k]));
    // A state at rest at the origin has no size to be measured by: its own slope is one.
    if (std::isinf(size)) {
      for (const auto& s : series) size = std::max(size, log2_of(s[1]));
    }
    step = std::min(step, (log2_tolerance + size - last) / static_cast<double>(k));
  }
  return step;
}

struct Run {
  bool reached = false;
  std::string reason;
  std::vector<cln::cl_F> state;
  cln::cl_F time;
  unsigned long steps = 0;
};

cln::cl_F horner(const std::vector<cln::cl_F>& series, const cln::cl_F& h) {
  cln::cl_F value = series.back();
  for (std::size_t k = series.size() - 1; k-- > 0;) value = value * h + series[k];
  return value;
}

Run integrate(const Program& rhs, const std::vector<cln::cl_R>& initial, const cln::cl_R& duration,
              int digits, const std::vector<cln::cl_R>& parameters,
              const std::function<bool()>& give_up) {
  const int working = digits + kGuardDigits;
  const Arithmetic<cln::cl_F> arithmetic(working);
  const int order = static_cast<int>(1.15 * working) + 4;
  const double log2_tolerance = -(digits + 2) * kLog2Of10;
  const auto rounded = [&](const std::vector<cln::cl_R>& values) {
    std::vector<cln::cl_F> result;
    for (const cln::cl_R& v : values) result.push_back(arithmetic.from(v));
    return result;
  };
  Run run;
  run.state = rounded(initial);
  run.time = arithmetic.from(cln::cl_RA(0));
  const cln::cl_F end = arithmetic.from(duration);
  TaylorJet<cln::cl_F> jet(rhs, arithmetic, rounded(parameters), order);
  while (run.time < end) {
    if (run.steps == kMaxSteps) return run.reason = "more steps than a reference may take", run;
    if (give_up && give_up()) return run.reason = "stopped", run;
    const std::vector<std::vector<cln::cl_F>>* series = nullptr;
    try {
      series = &jet.expand(run.time, run.state);
    } catch (const std::domain_error& problem) {
      return run.reason = problem.what(), run;
    }
    const cln::cl_F left = end - run.time;
    const double step = log2_step(*series, log2_tolerance);
    // A step that no longer moves the time means that the solution has no value further on.
    if (step < log2_of(end) - (working - 2) * kLog2Of10 || std::isnan(step))
      return run.reason = "the solution has a singularity here", run;
    const bool last = step >= log2_of(left);
    const cln::cl_F h = last ? left : power_of_two(step, arithmetic);
    for (std::size_t i = 0; i < run.state.size(); ++i) run.state[i] = horner((*series)[i], h);
    run.time = last ? end : run.time + h;
    ++run.steps;
  }
  run.reached = true;
  return run;
}

double relative_difference(const std::vector<cln::cl_F>& a, const std::vector<cln::cl_F>& b) {
  double largest = 0;
  double size = -std::numeric_limits<double>::infinity();
  for (const cln::cl_F& x : b) size = std::max(size, log2_of(x));
  for (std::size_t i = 0; i < a.size(); ++i) {
    // A component that is tiny beside the others is measured against them.
    const double own = std::max(log2_of(b[i]), size - 40);
    const double difference = log2_of(a[i] - b[i]);
    if (!std::isinf(difference)) largest = std::max(largest, std::exp2(difference - own));
  }
  return largest;
}

}  // namespace

Reference reference_solution(const Program& rhs, const std::vector<cln::cl_R>& initial,
                             const cln::cl_R& duration, int digits,
                             const std::vector<cln::cl_R>& parameters,
                             const std::function<bool()>& give_up) {
  constexpr int kLeastDigits = 20;
  constexpr int kMoreDigits = 10;
  digits = std::max(digits, kLeastDigits);
  const Run first = integrate(rhs, initial, duration, digits, parameters, give_up);
  Reference reference;
  reference.digits = digits + kMoreDigits;
  Run second = first.reached
                   ? integrate(rhs, initial, duration, reference.digits, parameters, give_up)
                   : first;
  reference.reached = second.reached;
  reference.reason = second.reason;
  reference.time = second.time;
  reference.steps = second.steps;
  if (reference.reached) reference.error_bound = relative_difference(first.state, second.state);
  reference.state = std::move(second.state);
  return reference;
}

}  // namespace casimir
