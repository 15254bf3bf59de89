// casimir integrate: one scene by one method, with the state, the drift and the samples.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "tools/analysis/conversion.hpp"
#include "tools/analysis/run/assessed_run.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/motion_options.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/cli/watched_run.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/digits_run.hpp"
#include "tools/runs/enclosed_run.hpp"
#include "tools/runs/ensemble_run.hpp"
#include "tools/runs/frequency_run.hpp"
#include "tools/runs/map_run.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/runs/trust_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

struct IntegrateArguments {
  Common common;
  RunOptions run;
  KeptParameters kept;
  OtherStart start;
  MotionOptions picture;
  PictureOptions print;
  std::string case_name, method = "auto", output, ensemble, in, as, certificate;
  std::vector<std::string> observe;
  double every = 0;
  int jobs = 0;
  std::optional<int> digits;
  std::size_t frequencies = 0;
  std::optional<std::string> initial_radius;
  bool general = false, validated = false;
};

/// What is shown: the states themselves, or in the variables of `--as`.
class ComputedAnswer {
 public:
  ComputedAnswer(const Model& model, const PreparedScene& run, const std::string& as)
      : names_(run.specialisation.states) {
    if (as.empty()) return;
    if (names_.size() != model.variables.size())
      throw UsageError("--as needs every variable, and some are left out; see --observe");
    conversion_.emplace(model, bundled_atlas(model.limits), as);
    names_ = conversion_->names();
  }

  const std::vector<std::string>& names() const { return names_; }

  /// \throws SingularPoint  with the time
  std::vector<double> operator()(double t, const std::vector<double>& state) const {
    if (!conversion_) return state;
    return at(t, [&] { return (*conversion_)(state); });
  }

  /// What is said of the end of a run is about these variables. \return  warnings
  std::vector<std::string> judge(AssessedRun& judged) const {
    if (!conversion_) return {};
    const Trajectory& trajectory = judged.trajectory;
    const ConvertedState end =
        at(trajectory.time, [&] { return conversion_->assessed(trajectory.state); });
    judged.trust.error_estimate *= end.growth;
    judged.trust.input_rounding *= end.growth;
    if (end.undetermined.empty()) return {};
    return {fmt::format(
        "{}: not determined by the variables that were integrated; each state has one value of "
        "many, and from state to state these are no motion: --in integrates in these variables",
        fmt::join(end.undetermined, ", "))};
  }

 private:
  /// Where the variables are singular, the time is said. \throws SingularPoint
  template <class Compute>
  static auto at(double t, const Compute& compute) -> decltype(compute()) {
    try {
      return compute();
    } catch (const SingularPoint& problem) {
      throw SingularPoint(
          fmt::format("at t = {}: {}\n  hint: without --as the run itself can be had",
                      exact_text(t), problem.what()));
    }
  }

  std::vector<std::string> names_;
  std::optional<Conversion> conversion_;
};

void write_samples(const std::string& path, const Specialisation& s, const ComputedAnswer& answer,
                   const Trajectory& trajectory) {
  std::vector<std::vector<double>> columns(answer.names().size());
  for (std::size_t k = 0; k < trajectory.samples.size(); ++k) {
    const auto state = answer(trajectory.sample_times[k], trajectory.samples[k]);
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].push_back(state[i]);
  }
  Table table{{{"t", trajectory.sample_times}}, {{"case", s.case_name}, {"scene", s.scene}}};
  for (std::size_t i = 0; i < columns.size(); ++i)
    table.columns.push_back({answer.names()[i], std::move(columns[i])});
  if (trajectory.status != Status::ok)
    table.note =
        fmt::format("stopped at t = {}: {}", exact_text(trajectory.time), trajectory.reason);
  write_table(path, table);
}

/// How the code of a run was made, in words.
struct CodeOfRun {
  const char *name, *made = "laid out", *run = "integrated";
  double seconds;
  bool from_cache;

  explicit CodeOfRun(const AssessedRun& run_of)
      : name("tables"), seconds(run_of.compiled->seconds), from_cache(run_of.compiled->from_cache) {
    bool compiled = run_of.compiled->compiled;
    if (compiled) name = "compiled";
    if (const auto& later = run_of.later) {
      compiled = later->compiled;
      seconds += later->seconds;
      from_cache = later->from_cache;
      name = compiled ? "interpreted, then compiled" : "interpreted";
      run = compiled ? "interpreted and integrated" : "interpreted";
    }
    if (compiled) made = from_cache ? "fetched from the cache" : "compiled";
  }
};

Json run_json(const Model& model, const PreparedScene& run, const ComputedAnswer& answer,
              const AssessedRun& judged, const RunWords& words) {
  const Specialisation& s = run.specialisation;
  const Trajectory& trajectory = judged.trajectory;
  Json json = {{"case", model.name},
               {"scene", s.scene},
               {"method", judged.method->name},
               {"tolerance", judged.settings.rtol},
               {"rtol", judged.settings.rtol},
               {"atol", judged.settings.atol},
               {"status", to_string(trajectory.status)},
               {"t", exact_text(trajectory.time)}};
  if (!judged.chosen.empty()) json["chosen"] = judged.chosen;
  if (!judged.projected.empty()) json["projected"] = judged.projected;
  json["state"] = Json::object();
  const std::vector<double> state = answer(trajectory.time, trajectory.state);
  for (std::size_t i = 0; i < state.size(); ++i)
    json["state"][answer.names()[i]] = exact_text(state[i]);
  json["invariants"] = Json::object();
  for (std::size_t i = 0; i < s.invariant_names.size(); ++i) {
    const InvariantRecord& record = trajectory.invariants[i];
    json["invariants"][s.invariant_names[i]] = {{"initial", exact_text(record.initial)},
                                                {"final", exact_text(record.final)},
                                                {"drift", exact_text(record.drift)}};
  }
  json["steps"] = trajectory.steps;
  json["rejected"] = trajectory.rejected;
  json["evaluations"] = trajectory.evaluations;
  const CodeOfRun code(judged);
  json["seconds"] = {{"generate", run.generate_seconds},
                     {"compile", code.seconds},
                     {"integrate", trajectory.seconds}};
  json["from_cache"] = code.from_cache;
  json["code"] = code.name;
  json["left_out"] = left_out_json(s);
  json["warnings"] = words.warnings;
  json["end_in_doubt"] = words.end_in_doubt;
  json["trust"] = to_json(judged.trust);
  if (trajectory.status != Status::ok) {
    json["stopped"] = {{"time", exact_text(trajectory.time)},
                       {"reason", trajectory.reason},
                       {"advice", words.advice}};
  }
  return json;
}

void print_run(const PreparedScene& run, const ComputedAnswer& answer, const AssessedRun& judged,
               const RunWords& words) {
  const Specialisation& s = run.specialisation;
  const Trajectory& trajectory = judged.trajectory;
  fmt::print("{}, scene '{}', {} at tolerance {:g}\n", s.case_name, printable(s.scene),
             judged.method->name, judged.settings.rtol);
  if (!judged.chosen.empty()) fmt::print("  chosen by auto: {}\n", judged.chosen);
  if (!judged.projected.empty())
    fmt::print("  every step ends on the level of {}\n", fmt::join(judged.projected, ", "));
  const CodeOfRun code(judged);
  fmt::print("  generated in {}, {} in {}, {} in {}: {} steps, {} rejected, {} evaluations\n",
             duration_text(run.generate_seconds), code.made, duration_text(code.seconds), code.run,
             duration_text(trajectory.seconds), trajectory.steps, trajectory.rejected,
             trajectory.evaluations);
  fmt::print("  t = {}\n", exact_text(trajectory.time));
  const std::vector<double> state = answer(trajectory.time, trajectory.state);
  for (std::size_t i = 0; i < state.size(); ++i)
    fmt::print("  {:<10} {:>25}\n", answer.names()[i], exact_text(state[i]));
  for (std::size_t i = 0; i < s.invariant_names.size(); ++i) {
    fmt::print("  {:<10} {:>25}   drift {:.1e}\n", s.invariant_names[i],
               exact_text(trajectory.invariants[i].final), trajectory.invariants[i].drift);
  }
  if (judged.trust.known && !judged.trust.unconfirmed && std::isfinite(judged.trust.error_estimate))
    fmt::print("  error of the state about {:.0e}; small changes of the start grow {:.0e} times\n",
               judged.trust.error_estimate, judged.trust.conditioning);
  for (const LeftOut& item : s.left_out)
    fmt::print("  left out: {} {}, {}\n", item.kind, item.name, item.reason);
  for (const std::string& warning : words.warnings) fmt::print("  warning: {}\n", warning);
}

/// What a run that stopped early says beside its answer. \return  the exit status
int report_stop(const PreparedScene& run, const AssessedRun& judged, const RunWords& words) {
  const Trajectory& trajectory = judged.trajectory;
  std::string state;
  for (std::size_t i = 0; i < run.specialisation.states.size(); ++i) {
    state += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", run.specialisation.states[i],
                         trajectory.state[i]);
  }
  std::cout.flush();
  const bool ended = trajectory.status == Status::drift_exceeded;
  std::cerr << fmt::format("casimir: error: the integration {} t = {}: {}\n  {}: {}\n  hint: {}\n",
                           ended ? "cannot be trusted to" : "stopped at",
                           exact_text(trajectory.time), trajectory.reason,
                           ended ? "state" : "last good state", state, words.advice);
  if (words.interrupted) return kInterrupted;
  return trajectory.status == Status::stopped ? kEnvironment : kNotContinued;
}

SceneOptions scene_options(const IntegrateArguments& options) {
  auto how = options.kept.in<SceneOptions>();
  if (options.general) {
    how.fold_parameters = false;
    how.observe = std::vector<std::string>{};
  }
  if (!options.observe.empty()) how.observe = options.observe;
  return how;
}

int integrate_members_of(const IntegrateArguments& options) {
  if (!options.in.empty() || !options.as.empty())
    throw UsageError("--in and --as do not go with --ensemble");
  if (options.run.asked.projects()) throw UsageError("--project does not go with --ensemble");
  if (options.every > 0)
    throw UsageError("--every does not go with --ensemble: the end of each member is written");
  return integrate_ensemble({options.common, options.run, options.kept, options.start,
                             options.case_name, options.method, options.ensemble, options.output,
                             scene_options(options), options.jobs});
}

/// Before anything is integrated: what cannot be drawn is bad input, and so are its names.
void check_picture(const Model& model, const Scene& scene, const PreparedScene& run,
                   const IntegrateArguments& options) {
  if (!options.picture.wanted()) return;
  const Motion start{.names = run.specialisation.states, .times = {0.0}, .states = {run.initial}};
  options.picture.picture(model, scene, start);
}

void draw_motion(const Model& model, const Scene& scene, const PreparedScene& run,
                 const AssessedRun& judged, const IntegrateArguments& options) {
  if (!options.picture.wanted()) return;
  draw(options.picture.picture(model, scene, motion_of(run, judged, options.every)),
       options.print.sheet(options.picture.file()));
  if (!options.common.json && !options.common.quiet)
    fmt::print("  drew {}\n", printable(options.picture.file(), 200));
}

int enclose_case(const IntegrateArguments& options) {
  if (options.picture.wanted()) throw UsageError("--plot does not go with --validated");
  if (!options.ensemble.empty()) throw UsageError("--ensemble does not go with --validated");
  if (options.general) throw UsageError("--general does not go with --validated");
  return integrate_validated({options.common, options.run, options.kept, options.start,
                              options.case_name, options.in, options.as, options.method,
                              options.output, options.every, options.digits, options.initial_radius,
                              options.observe, options.certificate});
}

/// Of a map: its steps are iterated, and what is about methods and errors of steps has no meaning.
int iterate_case(const MapCaseFile& file, const IntegrateArguments& options) {
  const RunRequest asked = options.run.request(options.common.limits);
  const bool of_methods = options.method != "auto" || asked.rtol || asked.atol || asked.tolerance ||
                          asked.step || asked.projects();
  if (of_methods || options.frequencies > 0 || options.picture.wanted() || options.general ||
      !options.observe.empty() || !options.in.empty() || !options.as.empty() || options.jobs > 0 ||
      asked.max_steps > 0 || options.kept.given())
    throw UsageError(
        "a map is iterated: of the options --scene, --param, --initial, --duration, --output and "
        "--every have a meaning");
  MapCaseFile started = file;
  started.file = options.start.in(file.file);
  return iterate_map({options.common, started, asked.duration, options.output, options.every});
}

void check_frequencies(const IntegrateArguments& options) {
  if (options.frequencies == 0) return;
  if (options.validated || options.digits || !options.ensemble.empty() || !options.as.empty() ||
      !options.output.empty() || options.picture.wanted())
    throw UsageError(
        "--frequencies reports on a run in double precision: it goes with none of --validated, "
        "--digits, --ensemble, --as, --output and --plot");
}

/// What goes with enclosures alone, or not with each other.
void check_unvalidated(const IntegrateArguments& options) {
  if (options.initial_radius) throw UsageError("--initial-radius needs --validated");
  if (!options.certificate.empty()) throw UsageError("--certificate needs --validated");
  for (const std::string& word : options.common.params)
    if (is_range(word)) throw UsageError("--param with a range of values needs --validated");
  if (options.picture.wanted() && (options.digits || !options.ensemble.empty()))
    throw UsageError("--plot goes with a run in double precision, not with --digits or --ensemble");
  if (options.picture.wanted() && !options.as.empty())
    throw UsageError("--plot does not go with --as; --in integrates and draws in other variables");
}

int integrate_case(const IntegrateArguments& options) {
  check_frequencies(options);
  options.picture.check();
  options.print.check(options.picture.wanted());
  if (options.validated) return enclose_case(options);
  check_unvalidated(options);
  if (options.digits) {
    if (!options.ensemble.empty()) throw UsageError("--digits does not go with --ensemble");
    if (options.run.asked.projects()) throw UsageError("--project does not go with --digits");
    return integrate_with_digits({options.common, options.run, options.kept, options.start,
                                  options.case_name, options.in, options.as, options.method,
                                  options.output, options.every, *options.digits,
                                  scene_options(options)});
  }
  if (!options.ensemble.empty()) return integrate_members_of(options);
  const AnyCaseFile file = load_any_case(options.case_name, options.common.limits);
  if (const auto* map = std::get_if<MapCaseFile>(&file)) return iterate_case(*map, options);
  if (options.jobs > 0) throw UsageError("--jobs needs --ensemble FILE.csv");
  const Model model = in_variables(options.kept.model_of(options.start.in(std::get<CaseFile>(file)),
                                                         options.common.parameter_values()),
                                   options.in);
  const Scene& scene = model.scene(options.common.scene);
  method_named(options.method);  // throws where there is none
  const PreparedScene run = prepare(model, scene, scene_options(options));
  if (options.frequencies > 0)
    return integrate_frequencies(
        {options.common, options.run, model, scene, run, options.method, options.frequencies});
  const ComputedAnswer answer(model, run, options.as);
  if (options.every > 0 && options.output.empty() && !options.picture.wanted())
    throw UsageError("--every needs --output FILE.csv or --plot FILE.svg");
  check_picture(model, scene, run, options);
  AssessmentOptions how{.method = options.method, .run = options.run.request(model.limits)};
  how.time_limit = options.common.time_limit;
  bool interrupted = false;
  how.around = [&](Settings& settings, const std::function<void()>& run_it) {
    // What is written to a file is worth keeping; without one an interrupt leaves nothing behind.
    const WatchedRun watched(settings, !options.common.quiet, !options.output.empty());
    run_it();
    interrupted = watched.interrupted();
  };
  if (!options.output.empty()) {
    const double span = std::abs(settings_for(how.run, run).duration);
    const double part = span > 0 ? span / 1000 : 1;  // of no time the start alone
    how.sample_every = options.every > 0 ? options.every : part;
  }
  AssessedRun judged = integrate_assessed(model, scene, run, how);
  const std::vector<std::string> of_variables = answer.judge(judged);
  RunWords words = words_of(judged, interrupted);
  words.warnings.insert(words.warnings.begin(), of_variables.begin(), of_variables.end());
  words.end_in_doubt = words.end_in_doubt || !of_variables.empty();
  if (!options.output.empty())
    write_samples(options.output, run.specialisation, answer, judged.trajectory);
  if (options.common.json) {
    print_json(run_json(model, run, answer, judged, words));
  } else if (!options.common.quiet) {
    print_run(run, answer, judged, words);
    if (!options.output.empty())
      fmt::print("  wrote {} states to {}\n", judged.trajectory.samples.size(),
                 printable(options.output, 200));
  }
  const int status =
      judged.trajectory.status == Status::ok ? kDone : report_stop(run, judged, words);
  // The answer first: pictures need a program that may be missing.
  draw_motion(model, scene, run, judged, options);
  return status;
}

}  // namespace

void register_integrate(CLI::App& program, Action& action) {
  auto options = std::make_shared<IntegrateArguments>();
  CLI::App* command = program.add_subcommand(
      "integrate", "Compile the specialised module of a scene and integrate it");
  add_common(*command, options->common);
  add_in(*command, options->in);
  options->start.add_to(*command);
  add_case(*command, options->case_name);
  command->add_option("--method", options->method, "A method, or auto: " + method_list())
      ->type_name("NAME");
  add_run_options(*command, options->run);
  add_projection(*command, options->run);
  add_as(*command, options->as);
  options->kept.add_to(*command);
  add_csv_output(*command, options->output, "Write states to this file");
  command
      ->add_option("--every", options->every,
                   "Time between the states written (default: a thousandth of the duration) or "
                   "drawn")
      ->type_name("DT")
      ->check(positive_number());
  command
      ->add_option("--ensemble", options->ensemble,
                   "Integrate many at once: a CSV file whose first line names variables and "
                   "parameters, with a line for each member")
      ->type_name("FILE.csv");
  command
      ->add_option("--digits", options->digits,
                   "Integrate with N decimal digits instead of double precision, by Taylor series")
      ->type_name("N");
  command
      ->add_option("--frequencies", options->frequencies,
                   "Report the N strongest frequencies of each variable instead, with their errors")
      ->type_name("N")
      ->check(CLI::Range(1, 40));
  command->add_flag("--validated", options->validated,
                    "Prove where the state is: a box that contains it, for the exact data");
  command
      ->add_option("--initial-radius", options->initial_radius,
                   "With --validated: every initial value may be off by so much")
      ->type_name("X");
  command
      ->add_option("--certificate", options->certificate,
                   "With --validated: write every step to this file, for casimir check")
      ->type_name("FILE");
  command->add_option("--jobs", options->jobs, "Threads for an ensemble (default: all processors)")
      ->type_name("N")
      ->check(count_from_one());
  command
      ->add_option("--observe", options->observe,
                   "States that must be computed; what they do not need is left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  options->picture.add_to(*command);
  options->print.add_to(*command);
  command->add_flag("--general", options->general,
                    "Parameters at run time and nothing left out, for comparison");
  command->callback([options, &action] { action = action_of(options, integrate_case); });
}

}  // namespace casimir::tools
