#include "tools/analysis/frequency/analysed_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/program/interpreter.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/section/periods.hpp"

namespace casimir {
namespace {

/// Samples to begin with, and the most that are taken.
constexpr std::size_t kFewestSamples = 4096, kMostSamples = std::size_t{1} << 18;
/// Beside the size of a state, an error of it that spoils frequencies.
constexpr double kBadState = 1e-3;

/// Which of the kept states are known up to multiples of 2 Pi.
std::vector<bool> angles_of(const Model& model, const Scene& scene, const PreparedScene& run) {
  std::vector<GiNaC::ex> functions;
  if (model.hamiltonian) functions.push_back(model.at_parameters(*model.hamiltonian, scene));
  for (const GiNaC::ex& rate : model.field) functions.push_back(model.at_parameters(rate, scene));
  for (const NamedExpression& c : model.casimirs)
    functions.push_back(model.at_parameters(c.value, scene));
  const std::vector<bool> all = angles_among(model.variables, functions);
  std::vector<bool> kept;
  for (const int index : run.specialisation.state_indices)
    kept.push_back(all[static_cast<std::size_t>(index)]);
  return kept;
}

MotionFrequencies frequencies_of(const AssessedRun& run, const std::vector<std::string>& states,
                                 const std::vector<bool>& angles, double interval,
                                 std::size_t samples, std::size_t lines) {
  SampledMotion motion{
      .names = states, .angles = angles, .states = run.trajectory.samples, .interval = interval};
  if (motion.states.size() < samples)
    throw EnvironmentError(
        fmt::format("{} of {} states of the motion are there", motion.states.size(), samples));
  motion.states.resize(samples);
  return frequencies_of(motion, lines);
}

/// Whether the variables change faster than their lines say: then lines have been folded back from
/// beyond the highest frequency that the samples can tell, to a place that no spectrum shows. The
/// mean square of a rate is the sum of (frequency * amplitude)^2 / 2 over all lines (Parseval), of
/// which those that were not found have no more than the rest at the highest frequency.
bool turns_faster(const AssessedRun& motion, const PreparedScene& run,
                  const MotionFrequencies& found) {
  constexpr double kFaster = 1.3;
  const Specialisation& s = run.specialisation;
  const Interpreter rates(s.rhs);
  const std::size_t n = found.variables.size(), count = motion.trajectory.samples.size();
  std::vector<double> inputs(s.rhs.inputs.size()), rate(s.rhs.outputs.size()), squares(n), sizes(n);
  std::ranges::copy(run.parameters, inputs.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double>& x = motion.trajectory.samples[k];
    std::ranges::copy(x, inputs.begin());
    inputs.back() = static_cast<double>(k) * found.interval;
    if (motion.settings.duration < 0) inputs.back() = -inputs.back();
    rates(inputs.data(), rate.data());
    for (std::size_t i = 0; i < n; ++i) {
      squares[i] += rate[i] * rate[i] / static_cast<double>(count);
      sizes[i] += x[i] * x[i] / static_cast<double>(count);
    }
  }
  const double highest = std::numbers::pi / found.interval;
  for (std::size_t i = 0; i < n; ++i) {
    const VariableSpectrum& variable = found.variables[i];
    // Of an angle q the lines are those of exp(i q), whose rate has the size of that of q.
    double known = 0;
    for (const MotionLine& line : variable.lines)
      known += std::pow(line.frequency * line.amplitude, 2) / (variable.angle ? 1 : 2);
    const double size = variable.angle ? 1 : sizes[i];
    known += std::pow(variable.rest * highest, 2) * size;
    if (!(squares[i] <= kFaster * kFaster * known)) return true;  // also what is no number
  }
  return false;
}

}  // namespace

AnalysedMotion analysed_motion(const Model& model, const Scene& scene, const PreparedScene& run,
                               const AssessmentOptions& how, std::size_t lines) {
  const double duration = std::abs(settings_for(how.run, run).duration);
  if (!(duration > 0)) throw RequestError("frequencies need a duration that is not 0");
  const std::vector<bool> angles = angles_of(model, scene, run);
  AnalysedMotion result;
  bool folded = false;
  for (std::size_t samples = kFewestSamples;; samples *= 4) {
    AssessmentOptions denser = how;
    denser.sample_every = duration / static_cast<double>(samples);
    result.run = integrate_assessed(model, run, denser);
    if (result.run.trajectory.status != Status::ok) return result;
    MotionFrequencies& found = result.found;
    found = frequencies_of(result.run, run.specialisation.states, angles, denser.sample_every,
                           samples, lines);
    folded = turns_faster(result.run, run, found);
    if (4 * samples > kMostSamples) break;
    if (!folded && (found.near_folding <= kFolded || !found.settled)) break;
  }
  if (folded) {
    result.found.settled = false;
    result.found.base.clear();
    result.found.base_errors.clear();
    result.found.warnings.push_back(fmt::format(
        "the variables change faster than these lines say: some are beyond {:.4g}, the highest "
        "frequency that {} states can tell, and seen at another; take a shorter duration",
        std::numbers::pi / result.found.interval, result.found.samples));
  }
  const ErrorEstimate& trust = result.run.trust;
  if (trust.known && trust.error_estimate > kBadState)
    result.found.warnings.insert(
        result.found.warnings.begin(),
        "the state at the end is not known well enough: the frequencies are those of a motion "
        "near this one, at most");
  return result;
}

}  // namespace casimir
