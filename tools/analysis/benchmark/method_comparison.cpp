#include "tools/analysis/benchmark/method_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/compile.hpp"
#include "runtime/work_precision.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/estimate/reference_state.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {
namespace {

/// An end state so far off, in sizes of the state, has nothing to do with the reference.
constexpr double kWrong = 0.1;

/// A contender ready to run.
struct Ready {
  ComparedMethod contender;
  const Method* method;
  const PreparedScene* run;
  CompiledModule compiled;
};

void tell(const ComparisonOptions& options, const std::string& what, double share) {
  if (options.progress) options.progress(what, share);
}

/// The code before and after: parameters at run time and every state, and the scene's own.
struct Codes {
  PreparedScene specialised, general;

  bool same_states() const {
    return general.specialisation.states == specialised.specialisation.states;
  }
  /// Where the states of the specialised code are among those of `run`.
  std::vector<int> places_in(const PreparedScene& run) const {
    if (&run == &specialised || same_states()) return {};
    std::vector<int> places;
    for (const std::string& state : specialised.specialisation.states) {
      const auto& all = run.specialisation.states;
      places.push_back(static_cast<int>(std::find(all.begin(), all.end(), state) - all.begin()));
    }
    return places;
  }
};

/// The first line of a compiler's complaint that says what is wrong, or of any other message.
std::string short_reason(const std::string& message) {
  const std::size_t error = message.find("error: ");
  std::string line = error == std::string::npos ? message : message.substr(error + 7);
  line = line.substr(0, line.find('\n'));
  return printable(line, 200);
}

/// Compiles for every method. Whoever cannot be had is left out with a note: libraries beside us
/// always, methods of our own where nobody asked for them by name.
class Gathering {
 public:
  Gathering(const ComparisonOptions& options, const Codes& codes, MethodComparison& contest)
      : options_(options), codes_(codes), contest_(contest) {}

  std::vector<Ready> run() && {
    const bool asked = !options_.methods.empty();
    const std::vector<std::string>& names = asked ? options_.methods : usual_methods();
    for (std::size_t i = 0; i < names.size(); ++i) {
      tell(options_, "compiling", static_cast<double>(i) / static_cast<double>(names.size()));
      const Method& method = method_named(names[i]);
      // A library of headers alone, which are compiled with the equations.
      const bool slow = !method.outside.empty() && !method.header.empty();
      if (!(options_.quick && !asked && slow)) add(method, asked);
    }
    if (ready_.empty()) throw EnvironmentError("there is nothing to measure: " + first_reason_);
    // Ours first; the order asked for otherwise.
    std::stable_partition(ready_.begin(), ready_.end(),
                          [](const Ready& r) { return r.contender.own(); });
    return std::move(ready_);
  }

 private:
  void add(const Method& method, bool asked) {
    try {
      add_specialised(method, asked);
      if (method.outside.empty()) add_general(method);
    } catch (const EnvironmentError& problem) {
      if (asked && method.outside.empty()) throw;
      if (first_reason_.empty()) first_reason_ = problem.what();
      contest_.notes.push_back(
          fmt::format("{} is left out: {}", method.name, short_reason(problem.what())));
    }
  }

  void add_specialised(const Method& method, bool asked) {
    CompiledModule module = compile_for(codes_.specialised, method);
    // A series method that was compiled, whatever its name, is compiled only once.
    if (method.series && module.compiled && !asked && !compiled_series_.empty()) {
      contest_.notes.push_back(
          fmt::format("{} is left out: here it is the same as {}", method.name, compiled_series_));
      duplicate_ = &method;
      return;
    }
    if (method.series && module.compiled) compiled_series_ = method.name;
    if (!module.warning.empty())
      contest_.notes.push_back(fmt::format("{}: {}", method.name, module.warning));
    tables_ = !module.compiled;
    ready_.push_back(
        {contender(method, "specialised"), &method, &codes_.specialised, std::move(module)});
  }

  void add_general(const Method& method) {
    if (duplicate_ == &method) return;
    // The tables of a kernel that nothing is compiled for hold the values of the parameters.
    if (tables_ && codes_.same_states()) return;
    ready_.push_back({contender(method, "general"), &method, &codes_.general,
                      compile_for(codes_.general, method)});
  }

  static ComparedMethod contender(const Method& method, const char* code) {
    return {std::string(method.name), code, std::string(method.outside)};
  }

  const ComparisonOptions& options_;
  const Codes& codes_;
  MethodComparison& contest_;
  std::vector<Ready> ready_;
  std::string compiled_series_, first_reason_;
  const Method* duplicate_ = nullptr;
  bool tables_ = false;
};

Entrant entrant_of(const Ready& ready, const Codes& codes, const RunRequest& asked,
                   double tolerance) {
  RunRequest run = asked;
  run.tolerance = tolerance;
  const Settings settings = settings_for(run, *ready.run);
  return {&ready.compiled.module, ready.method,          settings,
          ready.run->initial,     ready.run->parameters, codes.places_in(*ready.run)};
}

/// The row of a sample: its status is more than how the run ended.
Row row_of(const MethodComparison& contest, const Ready& ready, const Entrant& entrant,
           const ReferenceState& truth, const Sample& sample) {
  Row row{.case_name = contest.case_name,
          .scene = contest.scene,
          .method = ready.contender.method,
          .code = ready.contender.code,
          .tolerance = entrant.settings.rtol,
          .error = sample.error,
          .drift = sample.drift,
          .seconds = sample.seconds,
          .spread = sample.spread,
          .rounds = sample.rounds,
          .steps = sample.steps,
          .evaluations = sample.evaluations,
          .status = sample.status};
  judge_row(row, sample, explained_error(entrant, sample, truth, contest.conditioning),
            ready.contender.own());
  return row;
}

void measure_all(const std::vector<Ready>& ready, const Codes& codes, const ReferenceState& truth,
                 const ComparisonOptions& options, MethodComparison& contest) {
  std::vector<double> tolerances = options.tolerances;
  std::sort(tolerances.begin(), tolerances.end(), std::greater<>());
  std::vector<Entrant> entrants;
  std::vector<const Ready*> whose;
  for (const Ready& one : ready) {
    contest.contenders.push_back(one.contender);
    for (const double tolerance : tolerances) {
      entrants.push_back(entrant_of(one, codes, options.run, tolerance));
      whose.push_back(&one);
    }
  }
  Plan plan{.budget = options.budget, .rounds = options.repeat};
  // A run longer than that would take the time of all others.
  constexpr double kLargestPart = 1. / 40, kAlwaysAllowed = 0.05;
  plan.longest_run = options.repeat > 0 ? std::numeric_limits<double>::infinity()
                                        : std::max(options.budget * kLargestPart, kAlwaysAllowed);
  plan.give_up = options.give_up;
  plan.progress = [&](double share) { tell(options, "measuring", share); };
  std::vector<Sample> samples;
  try {
    samples = measure(entrants, truth, plan);
  } catch (const Abandoned&) {
    throw EnvironmentError("the time limit was reached");
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    contest.rows.push_back(row_of(contest, *whose[i], entrants[i], truth, samples[i]));
}

}  // namespace

void judge_row(Row& row, const Sample& sample, double explained, bool own) {
  if (!sample.refused.empty()) {
    row.end = RowEnd::refused;
    row.reason = sample.refused;
  } else if (sample.too_slow) {
    row.end = RowEnd::too_slow;
    row.reason = "a run takes too much of the time for all";
  } else if (sample.status == Status::ok) {
    // Written so that an error that is not a number has no explanation.
    if (!(sample.error <= explained)) {
      row.reason =
          fmt::format("tolerance and conditioning explain an error of {:.1e} at most", explained);
      row.failed = own;
    } else if (!(sample.error < kWrong)) {
      row.reason = "the end state is another one; the tolerance is too coarse for this motion";
    }
    if (!row.reason.empty()) row.end = RowEnd::wrong;
  }
}

WorkPrecision MethodComparison::curve(const ComparedMethod& contender) const {
  std::vector<Measured> runs;
  for (const Row& row : rows) {
    if (row.method == contender.method && row.code == contender.code && row.ok())
      runs.push_back({row.error, row.seconds});
  }
  return WorkPrecision(std::move(runs));
}

const std::vector<std::string>& usual_methods() {
  static const std::vector<std::string> kUsual{
      "taylor",       "taylor-compiled", "dop853",
      "gauss8",       "gauss16",         "cvode-adams",
      "cvode-bdf",    "arkode-erk",      "odeint-fehlberg78",
      "odeint-dopri5"};
  return kUsual;
}

MethodComparison compare_methods(const Model& model, const Scene& scene,
                                 const ComparisonOptions& options) {
  MethodComparison contest;
  contest.case_name = model.name;
  contest.title = model.title.empty() ? model.name : model.title;
  contest.scene = scene.name;
  Codes codes{
      prepare(model, scene, options.code),
      prepare(model, scene, {.fold_parameters = false, .observe = std::vector<std::string>{}})};
  codes.specialised.duration = codes.general.duration =
      settings_for(options.run, codes.specialised).duration;
  for (const GiNaC::symbol& variable : model.variables)
    contest.all_states.push_back(variable.get_name());
  contest.states = codes.specialised.specialisation.states;
  contest.general = codes.specialised.specialisation.general;
  contest.specialised = codes.specialised.specialisation.specialised;
  tell(options, "reference solution", 0);
  const ReferenceStateOrReason truth = reference_state_of(scene, codes.specialised,
                                                          {.digits = options.digits,
                                                           .check_the_file = true,
                                                           .longest = options.reference_limit,
                                                           .give_up = options.give_up});
  if (options.give_up && options.give_up()) throw EnvironmentError("the time limit was reached");
  contest.no_reference = truth.reason;
  contest.failure = truth.failure;
  if (!truth.truth) return contest;
  contest.reference = truth.source;
  contest.error_bound = truth.error_bound;
  contest.digits = truth.digits;
  contest.conditioning = growth_of(codes.specialised, *truth.truth);
  const std::vector<Ready> ready = Gathering(options, codes, contest).run();
  measure_all(ready, codes, *truth.truth, options, contest);
  return contest;
}

}  // namespace casimir
