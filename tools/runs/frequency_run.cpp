#include "tools/runs/frequency_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tools/analysis/frequency/motion_frequencies.hpp"
#include "tools/analysis/run/assessed_run.hpp"
#include "tools/analysis/section/periods.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/watched_run.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// Samples to begin with, and the most that are taken.
constexpr std::size_t kFewestSamples = 4096, kMost = std::size_t{1} << 18;
/// Beside the size of a state, an error of it that spoils frequencies.
constexpr double kBadState = 1e-3;

/// Which of the kept states are known up to multiples of 2 Pi.
std::vector<bool> angles_of(const FrequencyRequest& request) {
  const Model& model = request.model;
  std::vector<GiNaC::ex> functions;
  if (model.hamiltonian)
    functions.push_back(model.at_parameters(*model.hamiltonian, request.scene));
  for (const GiNaC::ex& rate : model.field)
    functions.push_back(model.at_parameters(rate, request.scene));
  for (const NamedExpression& c : model.casimirs)
    functions.push_back(model.at_parameters(c.value, request.scene));
  const std::vector<bool> all = angles_among(model.variables, functions);
  std::vector<bool> kept;
  for (const int index : request.prepared.specialisation.state_indices)
    kept.push_back(all[static_cast<std::size_t>(index)]);
  return kept;
}

/// A motion and what frequency analysis says of it.
class FrequencyRun {
 public:
  explicit FrequencyRun(const FrequencyRequest& request) : request_(request) {}

  int run() {
    const double duration =
        std::abs(settings_for(request_.run.request(), request_.prepared).duration);
    if (!(duration > 0)) throw UsageError("--frequencies needs a duration that is not 0");
    for (std::size_t samples = kFewestSamples;; samples *= 4) {
      integrate(duration / static_cast<double>(samples));
      if (run_->trajectory.status != Status::ok) return stopped();
      analyse(duration / static_cast<double>(samples), samples);
      if (found_.near_folding <= kFolded || 4 * samples > kMost || !found_.settled) break;
    }
    warn();
    if (request_.common.json)
      print_json(json());
    else if (!request_.common.quiet)
      print();
    return kDone;
  }

 private:
  void integrate(double interval) {
    AssessmentOptions how{.method = request_.method, .run = request_.run.request()};
    how.time_limit = request_.common.time_limit;
    how.sample_every = interval;
    how.around = [&](Settings& settings, const std::function<void()>& run_it) {
      const WatchedRun watched(settings, !request_.common.quiet, false);
      run_it();
    };
    run_.emplace(integrate_assessed(request_.model, request_.prepared, how));
  }

  void analyse(double interval, std::size_t samples) {
    SampledMotion motion{.names = request_.prepared.specialisation.states,
                         .angles = angles_of(request_),
                         .states = run_->trajectory.samples,
                         .interval = interval};
    if (motion.states.size() < samples)
      throw SystemError(
          fmt::format("{} of {} states of the motion are there", motion.states.size(), samples));
    motion.states.resize(samples);
    found_ = frequencies_of(motion, request_.lines);
  }

  void warn() {
    std::vector<std::string> warnings = words_of(*run_).warnings;
    const ErrorEstimate& trust = run_->trust;
    if (trust.known && trust.error_estimate > kBadState)
      warnings.emplace_back(
          "the state at the end is not known well enough: the frequencies are those of a motion "
          "near this one, at most");
    warnings.insert(warnings.end(), found_.warnings.begin(), found_.warnings.end());
    found_.warnings = std::move(warnings);
  }

  int stopped() const {
    std::cerr << fmt::format(
        "casimir: error: the integration stopped at t = {}: {}; there are no frequencies of a "
        "part of a motion\n",
        exact_text(run_->trajectory.time), run_->trajectory.reason);
    return run_->trajectory.status == Status::stopped ? kEnvironment : kNotContinued;
  }

  static Json line_json(const MotionLine& line) {
    Json json = {{"frequency", exact_text(line.frequency)},
                 {"amplitude", exact_text(line.amplitude)},
                 {"phase", exact_text(line.phase)},
                 {"error", exact_text(line.error)},
                 {"settled", line.settled}};
    json["combination"] = line.combination.empty() ? Json(nullptr) : Json(line.combination);
    return json;
  }

  Json json() const {
    const Specialisation& s = request_.prepared.specialisation;
    Json json = {{"case", request_.model.name},
                 {"scene", s.scene},
                 {"method", run_->method->name},
                 {"tolerance", run_->settings.rtol},
                 {"duration", exact_text(run_->settings.duration)},
                 {"samples", found_.samples},
                 {"quasi_periodic", found_.settled},
                 {"base", Json::array()},
                 {"variables", Json::object()},
                 {"warnings", found_.warnings}};
    for (std::size_t i = 0; i < found_.base.size(); ++i)
      json["base"].push_back({{"frequency", exact_text(found_.base[i])},
                              {"error", exact_text(found_.base_errors[i])}});
    for (const VariableSpectrum& variable : found_.variables) {
      Json one = {
          {"angle", variable.angle}, {"rest", exact_text(variable.rest)}, {"lines", Json::array()}};
      for (const MotionLine& line : variable.lines) one["lines"].push_back(line_json(line));
      json["variables"][variable.name] = std::move(one);
    }
    return json;
  }

  void print() const {
    fmt::print("{}, scene '{}', {} at tolerance {:g}: frequencies of the motion up to t = {:g}\n",
               request_.model.name, printable(request_.prepared.specialisation.scene),
               run_->method->name, run_->settings.rtol, run_->settings.duration);
    fmt::print("  {} states, Hanning's window of order 4; errors by the halves of the motion\n",
               found_.samples);
    if (!found_.base.empty()) {
      fmt::print("  base frequencies:");
      for (std::size_t i = 0; i < found_.base.size(); ++i)
        fmt::print("{} {:.15g} +- {:.0e}", i == 0 ? "" : ",", found_.base[i],
                   found_.base_errors[i]);
      fmt::print("\n");
    } else if (found_.settled) {
      fmt::print("  no three frequencies were found that all lines are combinations of\n");
    }
    fmt::print("\n  {:<10} {:>23} {:>9} {:>12} {:>9}  combination\n", "variable", "frequency",
               "error", "amplitude", "phase");
    for (const VariableSpectrum& variable : found_.variables)
      for (std::size_t k = 0; k < variable.lines.size(); ++k) {
        const MotionLine& line = variable.lines[k];
        const std::string name = variable.angle ? "e^i" + variable.name : variable.name;
        fmt::print("  {:<10} {:>23} {:>9.0e} {:>12.5g} {:>9.5f}  {}\n", k == 0 ? name : "",
                   exact_text(line.frequency), line.error, line.amplitude, line.phase,
                   line.combination.empty() ? (line.settled ? "" : "not in both halves")
                                            : fmt::format("{}", fmt::join(line.combination, " ")));
      }
    for (const std::string& warning : found_.warnings) fmt::print("  warning: {}\n", warning);
  }

  const FrequencyRequest& request_;
  std::optional<AssessedRun> run_;
  MotionFrequencies found_;
};

}  // namespace

int integrate_frequencies(const FrequencyRequest& request) { return FrequencyRun(request).run(); }

}  // namespace casimir::tools
