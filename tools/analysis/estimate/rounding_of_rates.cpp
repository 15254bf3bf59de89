#include "tools/analysis/estimate/rounding_of_rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "runtime/digits/big_float.hpp"
#include "runtime/evaluate.hpp"

namespace casimir {
namespace {

/// Enough for a cancellation of all digits of a double, and for many more.
constexpr slong kBitsOfRates = 512;
/// Of the largest rate on the way, the least difference that counts: some units of the last digit.
constexpr double kKept = 2e-15;

BigFloat exactly(double value) {
  BigFloat result;
  arf_set_d(result.mid(), value);
  return result;
}

/// Sums and products of states alone: their rounding is that of the state itself.
bool only_sums_and_products(const Program& program) {
  return std::ranges::all_of(program.code, [](const Instruction& line) {
    return line.op == Op::input || is_literal(line) || line.op == Op::add || line.op == Op::sub ||
           line.op == Op::mul || line.op == Op::neg;
  });
}

/// The states, the parameters and the time.
std::vector<double> inputs_of(const PreparedScene& run, double t, std::vector<double> x) {
  x.insert(x.end(), run.parameters.begin(), run.parameters.end());
  x.push_back(t);
  return x;
}

/// The rates in double less the true ones, at a state; nothing where these have no value.
std::optional<std::vector<double>> differences(const PreparedScene& run,
                                               const std::vector<double>& rates, double t,
                                               const std::vector<double>& x) {
  std::vector<BigFloat> inputs;
  for (const double value : inputs_of(run, t, x)) inputs.push_back(exactly(value));
  try {
    const std::vector<BigFloat> truth = evaluate(run.specialisation.rhs, inputs);
    std::vector<double> result;
    for (std::size_t i = 0; i < rates.size(); ++i)
      result.push_back(arf_get_d((exactly(rates[i]) - truth[i]).mid(), ARF_RND_NEAR));
    return result;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

/// Whether a number on the way to the rates is beyond all doubles, as x^2 in x/sqrt(1 + x^2) is
/// at 10^200, whose quotient is then 0.
bool goes_beyond_doubles(const PreparedScene& run, double t, const std::vector<double>& x) {
  Program lines = run.specialisation.rhs;
  lines.outputs.resize(lines.code.size());
  std::iota(lines.outputs.begin(), lines.outputs.end(), 0);
  lines.output_names.assign(lines.outputs.size(), "");
  try {
    return std::ranges::any_of(evaluate(lines, inputs_of(run, t, x)),
                               [](double value) { return std::isinf(value); });
  } catch (const std::domain_error&) {
    return false;
  }
}

}  // namespace

bool has_rates(const Module& module, double t, const std::vector<double>& x,
               const std::vector<double>& parameters) {
  std::vector<double> rates(x.size());
  module.functions().rhs(t, x.data(), parameters.empty() ? nullptr : parameters.data(),
                         rates.data());
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return std::ranges::all_of(x, is_finite) && std::ranges::all_of(rates, is_finite);
}

ErrorOfRates error_of_rates(const PreparedScene& run, const Module& module,
                            const Trajectory& trajectory, const std::vector<double>& sizes) {
  if (only_sums_and_products(run.specialisation.rhs)) return {};
  const Precision precision(kBitsOfRates);
  const double* const parameters = run.parameters.empty() ? nullptr : run.parameters.data();
  const std::size_t n = sizes.size();
  std::vector<double> rates(n), largest(n), worst(n), sum(n), own(n);
  std::vector<bool> beyond(n);
  for (std::size_t k = 0; k + 1 < trajectory.samples.size(); ++k) {
    const double t = trajectory.sample_times[k], step = trajectory.sample_times[k + 1] - t;
    const std::vector<double>& x = trajectory.samples[k];
    module.functions().rhs(t, x.data(), parameters, rates.data());
    const auto off = differences(run, rates, t, x);
    if (!off) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const double larger = std::max(std::abs(rates[i]), std::abs(rates[i] - (*off)[i]));
      largest[i] = std::max(largest[i], larger);
      own[i] = std::max(own[i], std::abs(x[i]));
      // What is below the normal doubles is 0 by right.
      const bool other =
          larger > std::numeric_limits<double>::min() && std::abs((*off)[i]) > larger / 2;
      beyond[i] = beyond[i] || (other && goes_beyond_doubles(run, t, x));
      worst[i] = std::max(worst[i], std::abs((*off)[i]));
      sum[i] += (*off)[i] * step;
    }
  }
  ErrorOfRates error;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(worst[i] > kKept * largest[i])) continue;
    error.rounding = std::max(error.rounding, std::abs(sum[i]) / sizes[i]);
    if (beyond[i] && sum[i] != 0)
      error.overflow = std::max(error.overflow, std::min(1., std::abs(sum[i]) / own[i]));
  }
  return error;
}

double rounding_of_rates_at(const PreparedScene& run, const Module& module, double t,
                            const std::vector<double>& x, double left) {
  if (only_sums_and_products(run.specialisation.rhs)) return 0;
  const Precision precision(kBitsOfRates);
  const double* const parameters = run.parameters.empty() ? nullptr : run.parameters.data();
  std::vector<double> rates(x.size());
  module.functions().rhs(t, x.data(), parameters, rates.data());
  const auto off = differences(run, rates, t, x);
  if (!off) return 0;
  double size = 0, most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    size = std::max(size, std::abs(x[i]) + std::abs(rates[i]) * left);
    most = std::max(most, std::abs((*off)[i]) * left);
  }
  return most == 0 ? 0 : most / size;
}

}  // namespace casimir
