#include "tools/analysis/run/smooth_method.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "runtime/evaluate.hpp"
#include "runtime/instruction_set.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"
#include "tools/analysis/run/taylor_path.hpp"

namespace casimir {
namespace {

/// Of smaller systems the model knows too little, and there is little to be won.
constexpr std::size_t kFewStates = 12;

/// dop853 must take less than this part of the time: the model is no better.
constexpr double kClearly = 0.7;

/// Whether a right-hand side may follow another formula beyond some point.
bool has_branches(const Program& rhs) {
  return std::any_of(rhs.code.begin(), rhs.code.end(), [](const Instruction& line) {
    return line.op == Op::abs || line.op == Op::sign || line.op == Op::atan2;
  });
}

/// For one term of one sum, compiled: measured with AVX-512 over so(8) and four bodies in a plane
/// (0.18 and 0.14), and for the others with the ratios that the tops have between instruction sets.
double term_cost() {
  const InstructionSet set = chosen_instruction_set();
  return set == InstructionSet::avx512 ? 0.15 : set == InstructionSet::avx2 ? 0.22 : 0.4;
}

/// A model of the costs, in nanoseconds for a stretch of time in which a solution changes by about
/// itself.
struct SmoothCosts {
  int states;
  double products;    ///< sums that the series need
  double operations;  ///< of one right-hand side, a function or a division counted as several
  double taylor(double tolerance) const;
  double dop853(double tolerance) const;
};

double SmoothCosts::taylor(double tolerance) const {
  using casimir_kernel::taylor::kManyStates;
  const int order = states >= kManyStates ? casimir_kernel::taylor::order_of_large(tolerance)
                                          : casimir_kernel::taylor::order_of_one(tolerance);
  constexpr double kStep = 40, kOrder = 8;  // what waits for what, whatever the size
  const double step = kStep + kOrder * order + term_cost() * products * order * order / 2;
  return step / std::pow(tolerance, 1. / order);
}

double SmoothCosts::dop853(double tolerance) const {
  // Twelve right-hand sides, and the sums of them for each state.
  constexpr double kStep = 40, kOperation = 0.1, kStages = 12, kSums = 90;
  // The error of a step is so small that it is longer than its order alone would say.
  constexpr double kOrder = 8, kLonger = 1.3;
  const double step = kStep + kOperation * (kStages * operations + kSums * states);
  return step / (kLonger * std::pow(tolerance, 1 / kOrder));
}

}  // namespace

const Method& smooth_method(const PreparedScene& run, double tolerance) {
  const Method& series = *find_method("taylor");
  const Specialisation& s = run.specialisation;
  if (!(tolerance > 0) || s.states.size() < kFewStates || has_branches(s.rhs) ||
      choose_taylor_path(s.rhs, s.limits, run.parameters, true).path != TaylorPath::compiled)
    return series;
  // A function has a sum or two of its own, and takes the time of many products where it is called.
  constexpr double kSumsOfFunction = 2, kOfFunction = 8;
  const OperationCount& count = s.specialised;
  const double functions = count.div + count.calls;
  const SmoothCosts costs{static_cast<int>(s.states.size()),
                          count.mul + kSumsOfFunction * functions,
                          count.mul + count.add + kOfFunction * functions};
  const bool clearly = costs.dop853(tolerance) < kClearly * costs.taylor(tolerance);
  return clearly ? *find_method("dop853") : series;
}

bool closed_form_pays(const PreparedScene& run, const Settings& settings) {
  const char* const wanted = std::getenv("CASIMIR_CLOSED_FORMS");
  if (wanted && std::string_view(wanted) == "off") return false;
  if (settings.fixed_step > 0 || !run.parameters.empty()) return false;
  // Series take about half a step for that, 0.3 to 1 us; the form of a top 2 ms, and 20 us each
  // time that it is shown, at most 4096 times.
  constexpr double kLongEnough = 1e5, kStepsOfSample = 30;
  std::vector<double> inputs = run.initial;
  inputs.push_back(0);  // the time
  double size = 0, rate = 0;
  try {
    for (const double of : evaluate(run.specialisation.rhs, inputs))
      rate = std::max(rate, std::abs(of));
  } catch (const std::domain_error&) {
    return false;
  }
  for (const double x : run.initial) size = std::max(size, std::abs(x));
  double least = kLongEnough;
  if (settings.sample_every > 0)
    least += kStepsOfSample * 2 * std::abs(settings.duration) / settings.sample_every;
  return std::abs(settings.duration) * rate > least * size;
}

}  // namespace casimir
