// casimir bench: error against run time, for specialised and general code, beside other libraries.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "tools/analysis/benchmark/method_comparison.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/bench/report.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/row_table.hpp"

namespace casimir::tools {
namespace {

struct BenchArguments {
  Common common;
  KeptParameters kept;
  OtherStart start;
  std::vector<std::string> case_names, outputs;
  std::string in, tag;
  std::string plot, format = "text";
  PictureOptions print;
  bool all = false;
  RunOptions run;
  ComparisonOptions contest{.tolerances = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10,
                                           1e-11, 1e-12, 1e-13, 1e-14, 1e-15}};
};

/// What it means for a command about one case that there is no reference state.
Exit exit_of(NoReference failure) {
  switch (failure) {
    case NoReference::none:
      break;
    case NoReference::contradicted:
      return kBadInput;
    case NoReference::took_too_long:
      return kEnvironment;
    case NoReference::not_reached:
      return kNotContinued;
  }
  return kDone;
}

/// A contest that could not be held, with the reason.
MethodComparison not_held(const std::string& name, const std::string& scene,
                          const std::string& reason) {
  MethodComparison contest;
  contest.case_name = contest.title = name;
  contest.scene = scene;
  contest.no_reference = reason;
  return contest;
}

MethodComparison hold(const CaseFile& file, const BenchArguments& options, Progress& progress) {
  const Model model = in_variables(
      options.kept.model_of(options.start.in(file), options.common.parameter_values()), options.in);
  const Scene& scene = model.scene(options.common.scene);
  ComparisonOptions what = options.contest;
  what.run = options.run.request(options.common.limits);
  what.code = options.kept.in<SceneOptions>();
  std::string doing;
  what.progress = [&](const std::string& now, double share) {
    if (now != doing) progress.begin(model.name + ": " + now);
    doing = now;
    progress.show(share);
  };
  return compare_methods(model, scene, what);
}

/// Every bundled case. One that has no such scene, or a file that is no case, is told and skipped.
void hold_all(const BenchArguments& options, Progress& progress, BenchReport& report) {
  const auto paths = bundled_flows(options.tag, options.common.limits);
  if (paths.empty())
    throw SystemError("no bundled cases were found; CASIMIR_CASES can name their folder");
  for (const auto& path : paths) {
    const auto skip = [&](const std::exception& problem) {
      report.contests.push_back(
          not_held(path.stem().string(), options.common.scene, problem.what()));
    };
    try {
      report.contests.push_back(hold(read_case(path, options.common.limits), options, progress));
    } catch (const CaseError& problem) {
      skip(problem);
    } catch (const ModelError& problem) {
      skip(problem);
    } catch (const RequestError& problem) {
      skip(problem);
    }
  }
}

BenchReport compare_methods_on_scenes(const BenchArguments& options) {
  BenchReport report{.machine = this_machine(),
                     .several = options.all || options.case_names.size() > 1};
  Progress progress(!options.common.quiet);
  if (options.all) hold_all(options, progress, report);
  for (const std::string& name : options.case_names) {
    const AnyCaseFile any = load_any_case(name, options.common.limits);
    if (std::holds_alternative<MapCaseFile>(any))
      throw UsageError(
          "a map has no error to be measured: it is what it is; bench CASE --method kahan,midpoint "
          "measures Kahan's map of a flow beside other methods, integrate and conserve iterate a "
          "map");
    report.contests.push_back(hold(std::get<CaseFile>(any), options, progress));
  }
  return report;
}

void write_page(const BenchReport& report, const std::string& path) {
  std::vector<std::string> pictures;
  std::string problem;
  for (std::size_t i = 0; i < report.contests.size(); ++i) {
    pictures.emplace_back();
    if (!report.contests[i].no_reference.empty() || !problem.empty()) continue;
    Plot plot = picture_of(report.contests[i]);
    plot.title.clear();  // the page has its own
    try {
      pictures.back() = svg_element(plot, fmt::format("picture-{}", i), path);
    } catch (const SystemError& missing) {
      problem = missing.what();
    }
  }
  OutputFile file(path);
  file.stream() << to_html(report, pictures);
  file.commit();
  if (!problem.empty()) throw SystemError(problem);
}

void print_comparison(const BenchReport& report, const BenchArguments& options) {
  if (options.common.json || options.format == "json") {
    print_json(to_json(report));
  } else if (!options.common.quiet) {
    std::cout << (options.format == "markdown" ? to_markdown(report) : to_text(report));
  }
  std::cout.flush();
}

void write_tables(const BenchReport& report, const BenchArguments& options) {
  for (const std::string& path : options.outputs) {
    if (is_page_name(path)) continue;
    write_table(path, table_of(report.rows()));
  }
}

void check_usage(const BenchArguments& options) {
  if (options.all == !options.case_names.empty())
    throw UsageError("bench needs either a CASE or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (options.run.asked.rtol || options.run.asked.atol)
    throw UsageError("bench runs at a range of tolerances: --tolerances X,Y, or --tolerance X");
  for (const std::string& path : options.outputs)
    if (!is_page_name(path)) check_table_name(path);
  options.print.check(!options.plot.empty());
  if (options.plot.empty()) return;
  check_plot_name(options.plot);
  if (options.all || options.case_names.size() > 1)
    throw UsageError("--plot draws one CASE; --output FILE.html draws them all");
}

int bench(const BenchArguments& asked) {
  check_usage(asked);
  BenchArguments options = asked;
  if (options.run.asked.tolerance) options.contest.tolerances = {*options.run.asked.tolerance};
  options.contest.give_up = time_limit(options.common.time_limit);
  const BenchReport report = compare_methods_on_scenes(options);
  // The rows first: pictures need a program that may be missing.
  write_tables(report, options);
  if (!report.several && !report.contests.front().no_reference.empty()) {
    const MethodComparison& contest = report.contests.front();
    std::cerr << "casimir: error: " << contest.no_reference << '\n';
    return exit_of(contest.failure);
  }
  print_comparison(report, options);
  if (!options.plot.empty())
    draw(picture_of(report.contests.front()), options.print.sheet(options.plot));
  for (const std::string& path : options.outputs)
    if (is_page_name(path)) write_page(report, path);
  const std::vector<Row> rows = report.rows();
  const bool failed =
      std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.failed; });
  return failed ? kFailed : kDone;
}

void add_measurement_options(CLI::App& command, ComparisonOptions& options, RunOptions& run) {
  command
      .add_option("--method", options.methods,
                  "Methods to run (default: all that suit the case), of " + method_list())
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  command
      .add_option("--tolerances", options.tolerances,
                  "Tolerances to run at (default: 1e-2, 1e-3, .., 1e-15)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("X,Y")
      ->check(positive_number());
  command
      .add_option("--budget", options.budget,
                  "Seconds of measuring a case: the more, the more repeated runs (default 8); a "
                  "run that takes a fortieth of it is given up")
      ->type_name("SECONDS")
      ->check(positive_number());
  command
      .add_option("--repeat", options.repeat,
                  "Time every run in exactly so many rounds, whatever it takes")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  add_run_options(command, run);
  command
      .add_option("--digits", options.digits, "Digits of our own reference solution (default 30)")
      ->check(CLI::Range(20, 1000));
}

}  // namespace

void register_bench(CLI::App& program, Action& action) {
  auto options = std::make_shared<BenchArguments>();
  CLI::App* command =
      program.add_subcommand("bench", "Error against run time, beside other libraries");
  command->footer(
      "Every method runs at every tolerance, in rounds and in changing order; times are medians.\n"
      "A row is marked wrong, and counts nowhere, if its end state is off by a tenth of a state's\n"
      "size, or by more than 1000 times what all its steps can do together: steps * growth of\n"
      "changes * tolerance. The latter, by a method of our own, makes the exit status 1.");
  add_common(*command, options->common);
  add_in(*command, options->in);
  options->start.add_to(*command);
  options->kept.add_to(*command);
  command->add_option("CASE", options->case_names,
                      "Bundled cases, case files, or - for standard input");
  add_all(*command, options->all, options->tag, "Every bundled case");
  add_measurement_options(*command, options->contest, options->run);
  command
      ->add_option("--output", options->outputs,
                   "Write the rows to a .csv, .npz or .h5 file, or all of it to an .html page "
                   "(repeatable)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  command
      ->add_option("--plot", options->plot,
                   "Draw error against run time to this .svg, .png, .pdf or .tex file")
      ->type_name("FILE");
  options->print.add_to(*command);
  command->add_option("--format", options->format, "text (default), markdown or json")
      ->check(one_of({"text", "markdown", "json"}))
      ->type_name("FORMAT");
  command->callback([options, &action] { action = action_of(options, bench); });
}

}  // namespace casimir::tools
