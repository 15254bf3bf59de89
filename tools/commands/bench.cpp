// casimir bench: error against run time, for specialised and general code, beside other libraries.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "tools/case_library.hpp"
#include "tools/cli.hpp"
#include "tools/kept_parameters.hpp"
#include "tools/output.hpp"
#include "tools/plot.hpp"
#include "tools/run_options.hpp"
#include "tools/run_report.hpp"

namespace casimir::tools {
namespace {

struct Options {
  Common common;
  RunOptions run;
  KeptParameters kept;
  std::string case_name, output, plot;
  std::vector<std::string> methods{"taylor",  "dop853",      "gauss8",
                                   "gauss16", "cvode-adams", "cvode-bdf"};
  std::vector<double> tolerances{1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13};
  int digits = 30;
};

/// A row whose end state has nothing to do with the reference is wrong, not fast.
constexpr double kWrong = 0.1;

struct Contender {
  const Method* method;
  const SceneRun* run;
  const char* code;
  CompiledModule compiled;
  std::string label() const {
    return std::string(method->name) + (std::string(code) == "general" ? " general" : "");
  }
};

Row measure_row(const Contender& contender, const Model& model, const Scene& scene,
                double tolerance, const Options& options, const Truth& truth,
                const std::function<bool()>& give_up) {
  RunOptions asked = options.run;
  asked.tolerance = tolerance;
  Settings settings = settings_for(asked, *contender.run);
  settings.give_up = give_up;
  const Sample sample = measure(contender.compiled.module, *contender.method, settings,
                                contender.run->initial, contender.run->parameters, truth);
  Row row{.case_name = model.name,
          .scene = scene.name,
          .method = std::string(contender.method->name),
          .code = contender.code,
          .tolerance = tolerance};
  row.error = sample.error;
  row.drift = sample.drift;
  row.seconds = sample.seconds;
  row.spread = sample.spread;
  row.steps = sample.steps;
  row.evaluations = sample.evaluations;
  row.status = to_string(sample.status);
  if (sample.status == Status::ok && !(sample.error < kWrong)) row.status = "wrong";
  row.failed = row.status != "ok";
  return row;
}

/// The time a method needs for an error, by interpolation between its rows (log-log); NaN outside.
double seconds_at(const std::vector<const Row*>& rows, double error) {
  double best = std::nan("");
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const Row& a = *rows[i];
    const Row& b = *rows[i + 1];
    if (!(a.error >= error && error >= b.error && b.error > 0)) continue;
    const double share =
        a.error == b.error ? 0 : std::log(a.error / error) / std::log(a.error / b.error);
    best = a.seconds * std::pow(b.seconds / a.seconds, share);
  }
  return best;
}

/// "times faster than" at equal error, beside every other contender.
std::string ratios(const std::vector<Row>& rows) {
  std::map<std::string, std::vector<const Row*>> by_label;
  std::vector<std::string> order;
  for (const Row& row : rows) {
    const std::string label = row.method + (row.code == "general" ? " general" : "");
    if (!by_label.contains(label)) order.push_back(label);
    std::vector<const Row*>& good = by_label[label];
    if (row.status == "ok") good.push_back(&row);
  }
  std::string text =
      "time at equal error (interpolated), and how many times longer than the fastest\n";
  text += fmt::format("  {:<22}", "error");
  constexpr double kErrors[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  for (const double error : kErrors) text += fmt::format("{:>18.0e}", error);
  text += '\n';
  std::map<double, double> fastest;
  for (const double error : kErrors) {
    for (const std::string& label : order) {
      const double t = seconds_at(by_label[label], error);
      if (!std::isnan(t) && (!fastest.contains(error) || t < fastest[error])) fastest[error] = t;
    }
  }
  for (const std::string& label : order) {
    text += fmt::format("  {:<22}", label);
    for (const double error : kErrors) {
      const double t = seconds_at(by_label[label], error);
      text += std::isnan(t) ? fmt::format("{:>18}", "-")
                            : fmt::format("{:>10} {:>6.1f}x", duration_text(t), t / fastest[error]);
    }
    text += '\n';
  }
  return text;
}

Plot work_precision_plot(const std::vector<Row>& rows, const Model& model, const Scene& scene) {
  Plot plot{fmt::format("{}, scene {}: error against run time", model.title, scene.name),
            "error at the end, relative to the size of each variable along the run",
            "run time, seconds",
            true,
            true,
            {}};
  for (const Row& row : rows) {
    const std::string label = row.method + (row.code == "general" ? " general" : "");
    if (plot.curves.empty() || plot.curves.back().name != label)
      plot.curves.push_back({label, {}, row.code == "general"});
    if (row.status == "ok") plot.curves.back().points.emplace_back(row.error, row.seconds);
  }
  return plot;
}

int bench(const Options& options) {
  if (!options.plot.empty()) check_plot_name(options.plot);
  const Model model =
      options.kept.model_of(load_case(options.case_name), options.common.parameter_values());
  const Scene& scene = model.scene(options.common.scene);
  const std::function<bool()> give_up = time_limit(options.common.time_limit);
  SceneRun specialised = prepare(model, scene, options.kept.in<SceneOptions>());
  SceneRun general =
      prepare(model, scene, {.fold_parameters = false, .observe = std::vector<std::string>{}});
  specialised.duration = general.duration = settings_for(options.run, specialised).duration;
  const TruthOrReason truth = truth_of(scene, specialised, options.digits, give_up);
  if (!truth.truth) throw UsageError("bench needs a reference: " + truth.reason);
  const bool same_states = general.specialisation.states == specialised.specialisation.states;
  std::vector<Contender> contenders;
  for (const std::string& name : options.methods) {
    const Method& method = method_named(name);
    contenders.push_back({&method, &specialised, "specialised", compile_for(specialised, method)});
    if (method.outside.empty() && same_states)
      contenders.push_back({&method, &general, "general", compile_for(general, method)});
  }
  std::vector<Row> rows;
  for (const Contender& contender : contenders) {
    for (const double tolerance : options.tolerances) {
      if (give_up && give_up()) throw SystemError("the time limit was reached");
      rows.push_back(
          measure_row(contender, model, scene, tolerance, options, *truth.truth, give_up));
    }
  }
  if (!options.output.empty()) {
    OutputFile file(options.output);
    write_csv(file.stream(), rows);
    file.commit();
  }
  if (options.common.json) {
    nlohmann::ordered_json json = to_json(rows);
    json["reference"] = truth.source;
    std::cout << json.dump(2) << '\n';
  } else if (!options.common.quiet) {
    std::cout << to_text(rows, true) << "reference: " << truth.source << '\n'
              << ratios(rows) << std::flush;
  }
  if (!options.plot.empty()) draw(work_precision_plot(rows, model, scene), options.plot);
  return kDone;
}

}  // namespace

void register_bench(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("bench", "Error against run time, beside other libraries");
  add_common(*command, options->common);
  command
      ->add_option("CASE", options->case_name,
                   "A bundled case, a case file, or - for standard input")
      ->required();
  command->add_option("--method", options->methods, "Methods to run, of " + method_list())
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  command->add_option("--tolerances", options->tolerances, "Tolerances to run at")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("X,Y")
      ->check(CLI::PositiveNumber);
  add_run_options(*command, options->run);
  options->kept.add_to(*command);
  command->add_option("--digits", options->digits, "Digits of our own reference (default 30)")
      ->check(CLI::Range(20, 1000));
  command->add_option("--output", options->output, "Write the rows to this CSV file")
      ->type_name("FILE.csv");
  command
      ->add_option("--plot", options->plot, "Draw error against run time to this .svg or .png file")
      ->type_name("FILE");
  command->callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace casimir::tools
