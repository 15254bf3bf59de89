// casimir conserve: integrates scenes with our own methods and checks the drift of every invariant.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/cli/progress.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/conserve_run.hpp"
#include "tools/runs/map_run.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/row_table.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

struct ConserveArguments {
  Common common;
  RunOptions run;
  KeptParameters kept;
  OtherStart start;
  std::string case_name, output, plot;
  PictureOptions print;
  std::string in, tag;
  std::vector<std::string> methods = conserving_methods();
  bool methods_given = false;
  double bound = 1e-9;
  bool all = false;
};

/// Of one scene: that of --scene, or the default one.
struct Picture {
  std::string title;
  std::vector<DriftRecord> drifts;
};

/// The bar over all that is run: `part` of it is one case, which begins at `before`.
struct ShareOfRuns {
  Progress& bar;
  double before = 0, part = 1;
};

void conserve_case(const CaseFile& file, const ConserveArguments& options,
                   const std::function<bool()>& give_up, const ShareOfRuns& share,
                   std::vector<Row>& rows, Picture* picture) {
  const Model model = in_variables(
      options.kept.model_of(options.start.in(file), options.common.parameter_values()), options.in);
  std::vector<const Scene*> scenes;
  if (options.common.scene_given)
    scenes.push_back(&model.scene(options.common.scene));
  else
    for (const Scene& scene : model.scenes) scenes.push_back(&model.scene(scene.name));
  if (scenes.empty() && !options.all) model.scene("default");  // throws: there is none
  const Scene* drawn = picture ? &model.scene(options.common.scene) : nullptr;
  if (picture) picture->title = fmt::format("{}, scene {}", model.name, drawn->name);
  ConservationOptions what{.run = options.run.request(options.common.limits),
                           .code = options.kept.in<SceneOptions>(),
                           .bound = options.bound,
                           .give_up = give_up};
  const double runs = static_cast<double>(scenes.size() * options.methods.size());
  double done = 0;
  if (share.bar.visible())
    what.progress = [&](double of_run) {
      share.bar.show(share.before + share.part * (done + std::min(of_run, 1.)) / runs);
    };
  for (const Scene* scene : scenes) {
    for (const std::string& method : options.methods) {
      share.bar.name(fmt::format("{}, {}, {}", model.name, printable(scene->name), method));
      share.bar.show(share.before + share.part * done / runs);
      rows.push_back(conserve_scene(model, *scene, method_named(method), what,
                                    scene == drawn ? &picture->drifts : nullptr));
      ++done;
    }
  }
}

/// Of a map: what it claims to keep is watched along the iterates.
void conserve_map_case(MapCaseFile file, const ConserveArguments& options,
                       const std::function<bool()>& give_up, const ShareOfRuns& share,
                       std::vector<Row>& rows) {
  const RunRequest asked = options.run.request(options.common.limits);
  const bool of_methods = options.methods_given || asked.rtol || asked.atol || asked.tolerance ||
                          asked.step || asked.projects() || !options.in.empty();
  if (of_methods || !options.plot.empty())
    throw UsageError(
        "a map is iterated: of the options --scene, --param, --initial, --duration, --bound and "
        "--output have a meaning");
  file.file = options.start.in(file.file);
  const MapModel map = options.kept.map_model_of(file, options.common.parameter_values());
  std::vector<const Scene*> scenes;
  if (options.common.scene_given)
    scenes.push_back(&map.base.scene(options.common.scene));
  else
    for (const Scene& scene : map.base.scenes) scenes.push_back(&map.base.scene(scene.name));
  if (scenes.empty() && !options.all) map.base.scene("default");  // throws: there is none
  for (const Scene* scene : scenes) {
    share.bar.name(fmt::format("{}, {}", map.base.name, printable(scene->name)));
    rows.push_back(conserve_map(map, *scene, asked.duration, options.bound, give_up));
  }
}

void conserve_any_case(const AnyCaseFile& any, const ConserveArguments& options,
                       const std::function<bool()>& give_up, const ShareOfRuns& share,
                       std::vector<Row>& rows, Picture* picture) {
  if (const auto* map = std::get_if<MapCaseFile>(&any))
    conserve_map_case(*map, options, give_up, share, rows);
  else
    conserve_case(std::get<CaseFile>(any), options, give_up, share, rows, picture);
}

std::vector<Row> conserve_cases(const ConserveArguments& options, Picture& picture) {
  const std::function<bool()> give_up = time_limit(options.common.time_limit);
  std::vector<Row> rows;
  Progress bar(!options.common.quiet);
  bar.begin("conserve");
  if (!options.all) {
    conserve_any_case(load_any_case(options.case_name, options.common.limits), options, give_up,
                      {bar}, rows, options.plot.empty() ? nullptr : &picture);
    return rows;
  }
  const auto paths = listed_cases(options.tag, options.common.limits);
  const double part = 1 / static_cast<double>(paths.size());
  double before = 0;
  for (const auto& path : paths) {
    conserve_any_case(read_any_case(path, options.common.limits), options, give_up,
                      {bar, before, part}, rows, nullptr);
    before += part;
  }
  return rows;
}

int conserve(const ConserveArguments& options) {
  if (options.all == !options.case_name.empty())
    throw UsageError("conserve needs either a CASE or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (options.all && !options.plot.empty()) throw UsageError("--plot needs a CASE");
  if (!options.plot.empty()) check_plot_name(options.plot);
  options.print.check(!options.plot.empty());
  Picture picture;
  const std::vector<Row> rows = conserve_cases(options, picture);
  if (!options.output.empty()) write_table(options.output, table_of(rows));
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.failed; });
  if (options.common.json) {
    print_json(to_json(rows));
  } else if (!options.common.quiet) {
    const bool with_error = std::any_of(rows.begin(), rows.end(),
                                        [](const Row& row) { return !std::isnan(row.error); });
    std::cout << to_text(rows, with_error);
    fmt::print("{}\n", conservation_sentence(rows, options.bound));
  }
  // The rows first: pictures need a program that may be missing.
  if (!options.plot.empty())
    draw(drift_picture(picture.title, picture.drifts), options.print.sheet(options.plot));
  return failed == 0 ? kDone : kFailed;
}

}  // namespace

void register_conserve(CLI::App& program, Action& action) {
  auto options = std::make_shared<ConserveArguments>();
  CLI::App* command = program.add_subcommand(
      "conserve", "Check the drift of the Hamiltonian, Casimirs and integrals along every scene");
  add_common(*command, options->common);
  add_in(*command, options->in);
  options->start.add_to(*command);
  command->add_option("CASE", options->case_name, kCaseText);
  add_all(*command, options->all, options->tag, "Every bundled case");
  command->add_option("--bound", options->bound, "Largest drift allowed (default 1e-9)")
      ->type_name("X")
      ->check(positive_number());
  CLI::Option* methods = command
                             ->add_option("--method", options->methods,
                                          "Methods to run (default: taylor,dop853,gauss8)")
                             ->delimiter(',')
                             ->allow_extra_args(false)
                             ->type_name("A,B");
  add_run_options(*command, options->run);
  options->kept.add_to(*command);
  add_csv_output(*command, options->output, "Write the rows to this file");
  command
      ->add_option("--plot", options->plot,
                   "Draw drift against time, of the default scene or that of --scene: a curve an "
                   "invariant, or with several methods a curve a method")
      ->type_name("FILE.svg|png|pdf");
  options->print.add_to(*command);
  command->callback([options, methods, &action] {
    options->methods_given = methods->count() > 0;
    action = action_of(options, conserve);
  });
}

}  // namespace casimir::tools
