#include "tools/runs/frequency_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tools/analysis/frequency/analysed_motion.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/watched_run.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

/// A motion and what frequency analysis says of it.
class FrequencyRun {
 public:
  explicit FrequencyRun(const FrequencyRequest& request) : request_(request) {}

  int run() {
    AssessmentOptions how{.method = request_.method,
                          .run = request_.run.request(request_.common.limits)};
    how.time_limit = request_.common.time_limit;
    how.around = [&](Settings& settings, const std::function<void()>& run_it) {
      const WatchedRun watched(settings, !request_.common.quiet, false);
      run_it();
    };
    motion_ =
        analysed_motion(request_.model, request_.scene, request_.prepared, how, request_.lines);
    if (motion_.run.trajectory.status != Status::ok) return stopped();
    const std::vector<std::string> warnings = words_of(motion_.run).warnings;
    motion_.found.warnings.insert(motion_.found.warnings.begin(), warnings.begin(), warnings.end());
    if (request_.common.json)
      print_json(json());
    else if (!request_.common.quiet)
      print();
    return kDone;
  }

 private:
  int stopped() const {
    std::cerr << fmt::format(
        "casimir: error: the integration stopped at t = {}: {}; there are no frequencies of a "
        "part of a motion\n",
        exact_text(motion_.run.trajectory.time), motion_.run.trajectory.reason);
    return motion_.run.trajectory.status == Status::stopped ? kEnvironment : kNotContinued;
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
                 {"method", motion_.run.method->name},
                 {"tolerance", motion_.run.settings.rtol},
                 {"duration", exact_text(motion_.run.settings.duration)},
                 {"samples", motion_.found.samples},
                 {"quasi_periodic", motion_.found.settled},
                 {"base", Json::array()},
                 {"variables", Json::object()},
                 {"warnings", motion_.found.warnings}};
    for (std::size_t i = 0; i < motion_.found.base.size(); ++i)
      json["base"].push_back({{"frequency", exact_text(motion_.found.base[i])},
                              {"error", exact_text(motion_.found.base_errors[i])}});
    for (const VariableSpectrum& variable : motion_.found.variables) {
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
               motion_.run.method->name, motion_.run.settings.rtol, motion_.run.settings.duration);
    fmt::print("  {} states, Hanning's window of order 4; errors by the halves of the motion\n",
               motion_.found.samples);
    if (!motion_.found.base.empty()) {
      fmt::print("  base frequencies:");
      for (std::size_t i = 0; i < motion_.found.base.size(); ++i)
        fmt::print("{} {:.15g} +- {:.0e}", i == 0 ? "" : ",", motion_.found.base[i],
                   motion_.found.base_errors[i]);
      fmt::print("\n");
    } else if (motion_.found.settled) {
      fmt::print("  no three frequencies were found that all lines are combinations of\n");
    }
    fmt::print("\n  {:<10} {:>23} {:>9} {:>12} {:>9}  combination\n", "variable", "frequency",
               "error", "amplitude", "phase");
    for (const VariableSpectrum& variable : motion_.found.variables)
      for (std::size_t k = 0; k < variable.lines.size(); ++k) {
        const MotionLine& line = variable.lines[k];
        const std::string name = variable.angle ? "e^i" + variable.name : variable.name;
        fmt::print("  {:<10} {:>23} {:>9.0e} {:>12.5g} {:>9.5f}  {}\n", k == 0 ? name : "",
                   exact_text(line.frequency), line.error, line.amplitude, line.phase,
                   line.combination.empty() ? (line.settled ? "" : "not in both halves")
                                            : fmt::format("{}", fmt::join(line.combination, " ")));
      }
    for (const std::string& warning : motion_.found.warnings)
      fmt::print("  warning: {}\n", warning);
  }

  const FrequencyRequest& request_;
  AnalysedMotion motion_;
};

}  // namespace

int integrate_frequencies(const FrequencyRequest& request) { return FrequencyRun(request).run(); }

}  // namespace casimir::tools
