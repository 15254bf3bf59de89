// casimir conserve: integrates scenes with our own methods and checks the drift of every invariant.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tools/atlas.hpp"
#include "tools/case_library.hpp"
#include "tools/cli.hpp"
#include "tools/drift_plot.hpp"
#include "tools/kept_parameters.hpp"
#include "tools/output.hpp"
#include "tools/run_options.hpp"
#include "tools/run_report.hpp"
#include "tools/truth.hpp"

namespace casimir::tools {
namespace {

struct Options {
  Common common;
  RunOptions run;
  KeptParameters kept;
  std::string case_name, output, plot;
  std::string in, tag;
  std::vector<std::string> methods{"taylor", "dop853", "gauss8"};
  double bound = 1e-9;
  bool all = false;
};

constexpr double kTolerance = 1e-12;
/// A stiff scene takes more from a method that is not made for it, and would take hours.
constexpr unsigned long long kMostStiffSteps = 200'000;

/// Whether a scene may be refused: its motion ends, comes close to where the variables end, or
/// takes another method.
bool may_be_refused(const Scene& scene) {
  return scene.extreme == "blowup" || scene.extreme == "gimbal" || scene.extreme == "stiff";
}

/// Which invariant drifted most, for the table.
double largest_drift(const Trajectory& trajectory) {
  double drift = 0;
  for (const InvariantRecord& record : trajectory.invariants) drift = std::max(drift, record.drift);
  return drift;
}

Row conserve_one(const Model& model, const Scene& scene, const Method& method,
                 const Options& options, const std::function<bool()>& give_up,
                 std::vector<DriftRecord>* drifts) {
  const SceneRun run =
      prepare(model, scene, options.kept.in<SceneOptions>({.observe = std::vector<std::string>{}}));
  Settings settings = settings_for(options.run, run, kTolerance);
  settings.give_up = give_up;
  if (scene.extreme == "stiff" && settings.max_steps == 0) settings.max_steps = kMostStiffSteps;
  DriftRecord drift(std::string(method.name), run.specialisation.invariant_names,
                    settings.duration);
  if (drifts) drift.follow(settings);
  Row row{.case_name = model.name,
          .scene = scene.name,
          .method = std::string(method.name),
          .tolerance = settings.rtol};
  if (!suits(run, method)) {
    row.status = "does not split";
    row.refused = true;
    return row;
  }
  Trajectory trajectory;
  try {
    trajectory =
        integrate(compile_for(run, method).module, method, settings, run.initial, run.parameters);
  } catch (const std::invalid_argument& problem) {
    throw UsageError(problem.what());
  }
  if (drifts) {
    drift.finish(trajectory);
    drifts->push_back(drift);
  }
  row.drift = largest_drift(trajectory);
  row.seconds = trajectory.seconds;
  row.steps = trajectory.steps;
  row.evaluations = trajectory.evaluations;
  row.status = to_string(trajectory.status);
  if (trajectory.status == Status::ok && !scene.reference.empty() && !options.run.duration) {
    const TruthOrReason truth = truth_of(scene, run, {.give_up = give_up});
    if (truth.truth) row.error = error_of(trajectory.state, *truth.truth);
  }
  row.refused = trajectory.status != Status::ok && may_be_refused(scene);
  // Written so that a drift that is not a number fails too.
  row.failed = !row.refused && (trajectory.status != Status::ok || !(row.drift <= options.bound));
  if (trajectory.status == Status::ok && row.failed)
    row.status = fmt::format("drift above {:g}", options.bound);
  return row;
}

/// Of one scene: that of --scene, or the default one.
struct Picture {
  std::string title;
  std::vector<DriftRecord> drifts;
};

void conserve_case(const CaseFile& file, const Options& options,
                   const std::function<bool()>& give_up, std::vector<Row>& rows, Picture* picture) {
  const Model model =
      in_variables(options.kept.model_of(file, options.common.parameter_values()), options.in);
  std::vector<const Scene*> scenes;
  if (options.common.scene_given)
    scenes.push_back(&model.scene(options.common.scene));
  else
    for (const Scene& scene : model.scenes) scenes.push_back(&model.scene(scene.name));
  if (scenes.empty() && !options.all) model.scene("default");  // throws: there is none
  const Scene* drawn = picture ? &model.scene(options.common.scene) : nullptr;
  if (picture) picture->title = fmt::format("{}, scene {}", model.name, drawn->name);
  for (const Scene* scene : scenes) {
    for (const std::string& method : options.methods)
      rows.push_back(conserve_one(model, *scene, method_named(method), options, give_up,
                                  scene == drawn ? &picture->drifts : nullptr));
  }
}

int conserve(const Options& options) {
  if (options.all == !options.case_name.empty())
    throw UsageError("conserve needs either a CASE or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (options.all && !options.plot.empty()) throw UsageError("--plot needs a CASE");
  if (!options.plot.empty()) check_plot_name(options.plot);
  const std::function<bool()> give_up = time_limit(options.common.time_limit);
  std::vector<Row> rows;
  Picture picture;
  if (options.all) {
    for (const auto& path : bundled_cases(options.tag))
      conserve_case(read_case(path), options, give_up, rows, nullptr);
  } else {
    conserve_case(load_case(options.case_name), options, give_up, rows,
                  options.plot.empty() ? nullptr : &picture);
  }
  if (!options.output.empty()) {
    OutputFile file(options.output);
    write_csv(file.stream(), rows);
    file.commit();
  }
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.failed; });
  if (options.common.json) {
    std::cout << to_json(rows).dump(2) << '\n';
  } else if (!options.common.quiet) {
    const bool with_error = std::any_of(rows.begin(), rows.end(),
                                        [](const Row& row) { return !std::isnan(row.error); });
    std::cout << to_text(rows, with_error);
    const auto refused =
        std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.refused; });
    fmt::print("{} of {} runs keep every invariant to {:g}{}\n",
               static_cast<std::ptrdiff_t>(rows.size()) - failed - refused, rows.size(),
               options.bound,
               refused == 0 ? ""
                            : fmt::format("; {} are refused: an extreme scene, or a Hamiltonian "
                                          "that does not split",
                                          refused));
  }
  // The rows first: pictures need a program that may be missing.
  if (!options.plot.empty()) draw(drift_picture(picture.title, picture.drifts), options.plot);
  return failed == 0 ? kDone : kFailed;
}

}  // namespace

void register_conserve(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "conserve", "Check the drift of the Hamiltonian, Casimirs and integrals along every scene");
  add_common(*command, options->common);
  add_in(*command, options->in);
  command->add_option("CASE", options->case_name,
                      "A bundled case, a case file, or - for standard input");
  command->add_flag("--all", options->all, "Every bundled case");
  command->add_option("--tag", options->tag, "With --all: only cases with this tag")
      ->type_name("TAG");
  command->add_option("--bound", options->bound, "Largest drift allowed (default 1e-9)")
      ->type_name("X")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--method", options->methods, "Methods to run (default: taylor,dop853,gauss8)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  add_run_options(*command, options->run);
  options->kept.add_to(*command);
  command->add_option("--output", options->output, "Write the rows to this CSV file")
      ->type_name("FILE.csv");
  command
      ->add_option("--plot", options->plot,
                   "Draw drift against time, of the default scene or that of --scene: a curve an "
                   "invariant, or with several methods a curve a method")
      ->type_name("FILE.svg|png");
  command->callback([options, &action] { action = [options] { return conserve(*options); }; });
}

}  // namespace casimir::tools
