#include "tools/analysis/frequency/analysed_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "runtime/program/interpreter.hpp"
#include "tools/analysis/error.hpp"
#include "tools/analysis/section/periods.hpp"

namespace casimir {
namespace {

/// Samples to begin with, and the most that are taken.
constexpr std::size_t kFewestSamples = 4096, kMostSamples = std::size_t{1} << 18;
/// Of a line that the error of a run makes of itself, or of a frequency that it moves: so many
/// times what the error at the end says.
constexpr double kOfError = 4;
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

/// The rate of each variable at each sample, by the time that runs on.
std::vector<std::vector<double>> rates_along(const AssessedRun& motion, const PreparedScene& run,
                                             double interval) {
  const Specialisation& s = run.specialisation;
  const Interpreter rates(s.rhs);
  const double way = motion.settings.duration < 0 ? -1 : 1;
  const std::size_t n = s.states.size();
  std::vector<double> inputs(s.rhs.inputs.size()), rate(s.rhs.outputs.size());
  std::ranges::copy(run.parameters, inputs.begin() + static_cast<std::ptrdiff_t>(n));
  std::vector<std::vector<double>> result(n);
  for (std::size_t k = 0; k < motion.trajectory.samples.size(); ++k) {
    std::ranges::copy(motion.trajectory.samples[k], inputs.begin());
    inputs.back() = way * static_cast<double>(k) * interval;
    rates(inputs.data(), rate.data());
    for (std::size_t i = 0; i < n; ++i) result[i].push_back(way * rate[i]);
  }
  return result;
}

/// exp(i (frequency * t + phase)) at the samples, one after the other.
class Turning {
 public:
  Turning(double frequency, double phase, double interval)
      : now_(std::polar(1., phase)), step_(std::polar(1., frequency * interval)) {}
  std::complex<double> next() {
    const std::complex<double> value = now_;
    now_ *= step_;
    return value;
  }

 private:
  std::complex<double> now_, step_;
};

/// What the lines of a variable leave of its rate; of an angle q, of that of exp(i q).
std::vector<std::complex<double>> rest_of_rate(const AssessedRun& motion, std::size_t i,
                                               const std::vector<double>& rates,
                                               const VariableSpectrum& variable, double interval) {
  std::vector<std::complex<double>> rest;
  for (std::size_t k = 0; k < rates.size(); ++k)
    rest.push_back(variable.angle ? std::complex<double>(0, rates[k]) *
                                        std::polar(1., motion.trajectory.samples[k][i])
                                  : rates[k]);
  for (const MotionLine& line : variable.lines) {
    Turning turning(line.frequency, line.phase, interval);
    for (std::complex<double>& value : rest) {
      const std::complex<double> rate =
          std::complex<double>(0, line.frequency * line.amplitude) * turning.next();
      value -= variable.angle ? rate : rate.real();
    }
  }
  return rest;
}

/// Whether a line has been folded back from beyond the highest frequency that the samples can tell:
/// it is at another place then, and its rate there is not frequency * amplitude, but that of where
/// it belongs. Each line is asked by itself, since a strong one that is in its place would hide a
/// weak one that is not.
/// \param noise  an amplitude that the error of the run may have: lines of that size are none.
bool has_folded_line(const VariableSpectrum& variable, double interval,
                     const std::vector<std::complex<double>>& rest, double noise) {
  constexpr double kMissed = 0.5, kLeastKnown = 1e-3;
  const auto count = static_cast<double>(rest.size());
  return std::ranges::any_of(variable.lines, [&](const MotionLine& line) {
    const double frequency = std::abs(line.frequency);
    if (!line.settled || line.error > kLeastKnown * frequency || line.amplitude <= noise ||
        frequency * count * interval < 2 * std::numbers::pi)
      return false;  // it is noise, or hardly a line
    Turning turning(-line.frequency, 0, interval), window(2 * std::numbers::pi / count, 0, 1);
    std::complex<double> there = 0;
    for (const std::complex<double>& value : rest)
      there += (1 - window.next().real()) * value * turning.next();
    const double said = frequency * line.amplitude / (variable.angle ? 1 : 2);
    return !(std::abs(there) / count <= kMissed * said);
  });
}

/// How far the states may be off along the run, relative to their sizes; 0 where it is not known.
double error_of(const AssessedRun& motion) {
  const ErrorEstimate& trust = motion.trust;
  return trust.known ? std::max(trust.error_estimate, trust.samples_error.value_or(0)) : 0;
}

/// The square root of the mean square of a variable; of an angle that of exp(i q).
double size_of(const AssessedRun& motion, std::size_t i, const VariableSpectrum& variable) {
  if (variable.angle) return 1;
  double square = 0;
  for (const std::vector<double>& state : motion.trajectory.samples) square += state[i] * state[i];
  return std::sqrt(square / static_cast<double>(motion.trajectory.samples.size()));
}

/// Whether the variables change faster than their lines say: then lines have been folded back to a
/// place that no spectrum shows. The mean square of a rate is the sum of
/// (frequency * amplitude)^2 / 2 over all lines (Parseval), of which those that were not found have
/// no more than the rest at the highest frequency.
bool turns_faster(const AssessedRun& motion, const PreparedScene& run,
                  const MotionFrequencies& found) {
  constexpr double kFaster = 1.3;
  const std::vector<std::vector<double>> rates = rates_along(motion, run, found.interval);
  const double highest = std::numbers::pi / found.interval;
  for (std::size_t i = 0; i < found.variables.size(); ++i) {
    const VariableSpectrum& variable = found.variables[i];
    const auto count = static_cast<double>(rates[i].size());
    double square = 0;
    for (const double rate : rates[i]) square += rate * rate / count;
    // Of an angle q the lines are those of exp(i q), whose rate has the size of that of q.
    const double size = size_of(motion, i, variable);
    double known = std::pow(variable.rest * highest * size, 2);
    for (const MotionLine& line : variable.lines)
      known += std::pow(line.frequency * line.amplitude, 2) / (variable.angle ? 1 : 2);
    if (!(square <= kFaster * kFaster * known)) return true;  // also what is no number
    if (has_folded_line(variable, found.interval,
                        rest_of_rate(motion, i, rates[i], variable, found.interval),
                        kOfError * error_of(motion) * size))
      return true;
  }
  return false;
}

/// The frequencies are those of the motion that the method made. Another frequency shows as a phase
/// that grows along the run, and so as a part of the error at its end: the whole of it may be that.
void add_error_of_run(AnalysedMotion& result, double duration) {
  MotionFrequencies& found = result.found;
  if (!result.run.trust.known) {
    found.warnings.emplace_back(
        "how far the states are off is not known: the errors of frequencies are those of the "
        "spectrum alone, without what the method adds");
    return;
  }
  if (result.run.unestimated)
    found.warnings.emplace_back(
        "of variables that are tiny beside others the errors of frequencies are those of the "
        "spectrum alone, without what the method adds");
  const double phase = kOfError * error_of(result.run);
  for (double& error : found.base_errors) error += phase / duration;
  for (std::size_t i = 0; i < found.variables.size(); ++i) {
    const double size = size_of(result.run, i, found.variables[i]);
    for (MotionLine& line : found.variables[i].lines)
      line.error += phase / duration * std::max(1., size / std::abs(line.amplitude));
  }
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
    result.run = integrate_assessed(model, scene, run, denser);
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
    for (VariableSpectrum& variable : result.found.variables)
      for (MotionLine& line : variable.lines) line.combination.clear();
    result.found.warnings.push_back(fmt::format(
        "the variables change faster than these lines say: some are beyond {:.4g}, the highest "
        "frequency that {} states can tell, and seen at another; take a shorter duration",
        std::numbers::pi / result.found.interval, result.found.samples));
  }
  add_error_of_run(result, duration);
  const ErrorEstimate& trust = result.run.trust;
  if (trust.known && trust.error_estimate > kBadState)
    result.found.warnings.insert(
        result.found.warnings.begin(),
        "the state at the end is not known well enough: the frequencies are those of a motion "
        "near this one, at most");
  return result;
}

}  // namespace casimir
