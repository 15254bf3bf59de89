#include "tools/analysis/frequency/analysed_motion.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace

AnalysedMotion analysed_motion(const Model& model, const Scene& scene, const PreparedScene& run,
                               const AssessmentOptions& how, std::size_t lines) {
  const double duration = std::abs(settings_for(how.run, run).duration);
  if (!(duration > 0)) throw RequestError("frequencies need a duration that is not 0");
  const std::vector<bool> angles = angles_of(model, scene, run);
  AnalysedMotion result;
  for (std::size_t samples = kFewestSamples;; samples *= 4) {
    AssessmentOptions denser = how;
    denser.sample_every = duration / static_cast<double>(samples);
    result.run = integrate_assessed(model, run, denser);
    if (result.run.trajectory.status != Status::ok) return result;
    MotionFrequencies& found = result.found;
    found = frequencies_of(result.run, run.specialisation.states, angles, denser.sample_every,
                           samples, lines);
    if (found.near_folding <= kFolded || 4 * samples > kMostSamples || !found.settled) break;
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
