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

/// The step after which the first terms left out are as large as the tolerance times the state: by
/// the root test on the last quarter of the coefficients, so that gaps in a series do not deceive.
double log2_step(const std::vector<std::vector<cln::cl_F>>& series, double log2_tolerance) {
  const std::size_t order = series[0].size() - 1;
  const auto size_of = [&](std::size_t k) {
    double size = -std::numeric_limits<double>::infinity();
    for (const auto& s : series) size = std::max(size, log2_of(s[k]));
    return size;
  };
  // A solution that starts at the origin is measured by its first coefficient that is not zero.
  std::size_t first = 0;
  while (first < order && std::isinf(size_of(first))) ++first;
  const double size = size_of(first);
  double log2_radius = std::numeric_limits<double>::infinity();
  for (std::size_t k = std::max(first + 1, order - order / 4); k <= order; ++k)
    log2_radius = std::min(log2_radius, (size - size_of(k)) / static_cast<double>(k - first));
  return log2_radius +
         log2_tolerance / static_cast<double>(std::max<std::size_t>(order - first, 1));
}

struct Run {
  bool reached = false;
  std::string reason;
  bool singular = false;
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
  const bool backward = cln::minusp(end);
  while (run.time != end) {
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
      return run.singular = true, run.reason = "the solution has a singularity here", run;
    const bool last = step >= log2_of(left);
    const cln::cl_F size = last ? left : power_of_two(step, arithmetic);
    const cln::cl_F h = !last && backward ? -size : size;
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
  constexpr int kRounds = 4;
  constexpr double kTrusted = 1e-12, kCredit = 1e-6;
  digits = std::max(digits, kLeastDigits);
  const double wanted = std::pow(10., -digits);
  int working = digits;
  Run run = integrate(rhs, initial, duration, working, parameters, give_up);
  Reference reference;
  for (int round = 0; round < kRounds && run.reached; ++round) {
    // What the motion has cost in digits so far is added to the next run.
    const double lost = round == 0 ? 0 : std::log10(reference.error_bound / wanted);
    working += kMoreDigits + (lost > 0 ? static_cast<int>(std::min(lost, 1000.)) : 0);
    const Run before = std::move(run);
    run = integrate(rhs, initial, duration, working, parameters, give_up);
    if (!run.reached) break;
    // The difference is what the run before had wrong. This one has ten digits more: six are
    // believed, where the runs agree well enough to trust that errors shrink in proportion.
    reference.error_bound = relative_difference(before.state, run.state);
    if (reference.error_bound < kTrusted) reference.error_bound *= kCredit;
    if (reference.error_bound <= wanted) break;
  }
  reference.reached = run.reached;
  reference.reason = run.reason;
  reference.singular = run.singular;
  reference.time = run.time;
  reference.state = std::move(run.state);
  reference.digits = working;
  reference.steps = run.steps;
  return reference;
}

}  // namespace casimir
