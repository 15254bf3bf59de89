// casimir sweep: the same thing at every point of a grid of parameters or initial states.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tools/analysis/sweep/sweep.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/section/request.hpp"
#include "tools/sweep/map_picture.hpp"
#include "tools/sweep/mpi_ranks.hpp"
#include "tools/sweep/study.hpp"
#include "tools/sweep/table.hpp"
#include "tools/text/runs/checked_members.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

struct SweepArguments {
  Common common;
  OtherStart start;
  RunOptions run;
  PictureOptions picture;
  std::string case_name, task = "integrate", method = "auto", output, plot, colour;
  std::vector<std::string> over, lets, observe;
  int jobs = 0;
  std::size_t orbits = 16, points = 200;
  bool restart = false;
};

/// Everything that a sweep needs, in each rank.
struct PreparedSweep {
  Model model;
  const Scene* scene;
  SweepStudy study;

  PreparedSweep(const SweepArguments& options, const CaseFile& file)
      : model(model_of(file, options.common.parameter_values())),
        scene(&model.scene(options.common.scene)),
        study(model, *scene, asked(options, file, model)) {}

  static StudyRequest asked(const SweepArguments& options, const CaseFile& file,
                            const Model& model) {
    StudyRequest request{options.task, options.method, options.over, options.lets};
    if (!options.observe.empty()) request.observe = options.observe;
    request.run = options.run.request(options.common.limits);
    if (follows_crossings(options.task)) request.section = section_request(file, model);
    request.orbits = options.orbits;
    request.points = options.points;
    return request;
  }
};

/// How often each status occurs.
std::map<std::string, std::size_t> counts_of(const std::vector<PointResult>& rows) {
  std::map<std::string, std::size_t> counts;
  for (const PointResult& row : rows) ++counts[to_string(row.status)];
  return counts;
}

struct SweepReport {
  const SweepArguments& options;
  const PreparedSweep& prepared;
  const Ranks& ranks;
  const SweepOutcome& outcome;
  std::string output;
  int threads = 1, lanes = 1;
  double seconds = 0;
  std::vector<CheckedMember> checked = {};
  std::vector<std::string> warnings = {};
};

Json sweep_json(const SweepReport& report) {
  const PreparedSweep& p = report.prepared;
  Json json = {{"case", p.model.name},
               {"scene", p.scene->name},
               {"method", p.study.method().name},
               {"tolerance", p.study.settings().rtol},
               {"over", Json::array()}};
  for (const Axis& axis : p.study.grid().axes)
    json["over"].push_back({{"name", axis.name},
                            {"from", exact_text(axis.values.front())},
                            {"to", exact_text(axis.values.back())},
                            {"points", axis.values.size()}});
  json["points"] = report.outcome.points;
  json["resumed"] = report.outcome.resumed;
  json["computed"] = report.outcome.computed;
  json["complete"] = report.outcome.complete;
  json["counts"] = counts_of(report.outcome.rows);
  json["file"] = report.outcome.complete ? Json(report.output) : Json(nullptr);
  if (!report.options.plot.empty())
    json["plot"] = report.outcome.complete ? Json(report.options.plot) : Json(nullptr);
  if (!report.outcome.complete) json["journal"] = report.outcome.journal;
  json["ranks"] = report.ranks.size();
  json["jobs"] = report.threads;
  json["lanes"] = report.lanes;
  json["seconds"] = report.seconds;
  if (!report.checked.empty()) json["checked"] = checked_json(report.checked, "point");
  json["warnings"] = report.warnings;
  return json;
}

void print_sweep(const SweepReport& report) {
  const PreparedSweep& p = report.prepared;
  const SweepOutcome& outcome = report.outcome;
  fmt::print("{}, scene '{}', {} at tolerance {:g}, {} point{}\n", p.model.name,
             printable(p.scene->name), p.study.method().name, p.study.settings().rtol,
             outcome.points, outcome.points == 1 ? "" : "s");
  for (const Axis& axis : p.study.grid().axes)
    fmt::print("  {} from {:g} to {:g}, {} value{}\n", axis_title(axis), axis.values.front(),
               axis.values.back(), axis.values.size(), axis.values.size() == 1 ? "" : "s");
  fmt::print("  {} computed in {} by {} rank{}, {} thread{} each, {} points in a register",
             outcome.computed, duration_text(report.seconds), report.ranks.size(),
             report.ranks.size() == 1 ? "" : "s", report.threads, report.threads == 1 ? "" : "s",
             report.lanes);
  fmt::print("{}\n", outcome.resumed > 0 ? fmt::format("; {} were there already", outcome.resumed)
                                         : std::string{});
  for (const auto& [status, count] : counts_of(outcome.rows))
    fmt::print("  {:<16} {:>8}\n", status, count);
  if (!report.checked.empty())
    fmt::print("  {}\n", checked_text(report.checked, "point", report.outcome.rows.size()));
  for (const std::string& warning : report.warnings) fmt::print("  warning: {}\n", warning);
  if (!outcome.complete) return;
  fmt::print("  wrote {}\n", printable(report.output, 200));
  if (!report.options.plot.empty()) fmt::print("  wrote {}\n", printable(report.options.plot, 200));
}

/// What went wrong, on stderr.
int sweep_status(const SweepReport& report, bool interrupted) {
  const SweepOutcome& outcome = report.outcome;
  std::cout.flush();
  if (!outcome.complete) {
    const char* const why = interrupted ? "interrupted" : "stopped by the time limit";
    const std::size_t done = outcome.resumed + outcome.computed;
    std::cerr << (done == 0
                      ? fmt::format("casimir: error: {} before any of {} points was done\n", why,
                                    outcome.points)
                      : fmt::format("casimir: error: {}: {} of {} points are done and kept in {}\n"
                                    "  hint: the same command goes on from there\n",
                                    why, done, outcome.points, outcome.journal));
    return interrupted ? kInterrupted : kEnvironment;
  }
  std::size_t failed = 0, first = 0;
  for (std::size_t i = outcome.rows.size(); i-- > 0;) {
    if (outcome.rows[i].status == Status::ok) continue;
    ++failed;
    first = i;
  }
  if (failed == 0) return kDone;
  std::string where;
  const std::vector<double> values = report.prepared.study.grid().at(first);
  for (std::size_t i = 0; i < values.size(); ++i)
    where += fmt::format("{}{} = {:g}", i == 0 ? "" : ", ",
                         axis_title(report.prepared.study.grid().axes[i]), values[i]);
  std::cerr << fmt::format(
      "casimir: error: {} of {} points could not be integrated to the end; the first is point {}, "
      "{}{}: {}\n",
      failed, outcome.points, first + 1, where,
      follows_crossings(report.options.task)
          ? std::string{}
          : ", at t = " + exact_text(outcome.rows[first].values.front()),
      report.prepared.study.task().reason(outcome.rows[first].status));
  return kNotContinued;
}

/// What is to be drawn, checked before any point is done.
std::optional<MapPicture> picture_of(const SweepArguments& options, const Grid& grid,
                                     const SweepTask& task) {
  options.picture.check(!options.plot.empty());
  if (options.plot.empty()) {
    if (!options.colour.empty()) throw UsageError("--colour goes with --plot FILE");
    return std::nullopt;
  }
  check_plot_name(options.plot);
  return map_picture(grid, task, options.colour, options.picture.sheet(options.plot));
}

int sweep_in(const Ranks& ranks, const SweepArguments& options) {
  if (options.over.empty())
    throw UsageError("sweep needs a grid: --over NAME=FROM:TO:N, such as --over r=1:2:11");
  if (ranks.size() > 1 && options.case_name == "-")
    throw UsageError("under mpirun only one process has standard input: give a case file");
  const CaseFile file = options.start.in(load_case(options.case_name, options.common.limits));
  const std::string output = options.output.empty() ? file.name + "-sweep.csv" : options.output;
  check_sweep_output(output);
  const PreparedSweep p(options, file);
  const Grid& grid = p.study.grid();
  const SweepTask& task = p.study.task();
  const std::optional<MapPicture> picture = picture_of(options, grid, task);
  Progress progress(ranks.speaks() && !options.common.quiet);
  progress.begin("sweep of " + p.model.name);
  hold_interrupts(true);
  SweepOptions how{.output = output, .restart = options.restart, .threads = options.jobs};
  how.give_up = [limit = time_limit(options.common.time_limit)] {
    return interrupt_held() || (limit && limit());
  };
  how.progress = [&](double share) { progress.show(share); };
  const Stopwatch watch;
  const SweepOutcome outcome =
      sweep_over(task, ranks, how, [&](const std::vector<PointResult>& rows) {
        const SweepTable table{p.model.name,
                               p.scene->name,
                               std::string(p.study.method().name),
                               p.study.settings().rtol,
                               grid,
                               task.columns(),
                               rows};
        write_sweep(output, table);
        if (picture) draw_map(*picture, table);
      });
  const bool interrupted = interrupt_held();
  hold_interrupts(false);
  if (!ranks.speaks()) return kDone;
  SweepReport report{options,         p,
                     ranks,           outcome,
                     output,          options.jobs > 0 ? options.jobs : ranks.processors(),
                     p.study.lanes(), watch.seconds()};
  if (outcome.complete) report.checked = p.study.check(outcome.rows);
  report.warnings = p.study.warnings(outcome.rows, report.checked);
  if (options.common.json)
    print_json(sweep_json(report));
  else if (!options.common.quiet)
    print_sweep(report);
  return sweep_status(report, interrupted);
}

int sweep(const SweepArguments& options) {
  const MpiRanks ranks;
  try {
    return sweep_in(ranks, options);
  } catch (const std::exception&) {
    // The same happens in every rank; one says it.
    if (ranks.speaks()) throw;
    return kDone;
  }
}

/// The grid, and what is done at its points.
void add_study(CLI::App& command, SweepArguments& options) {
  command
      .add_option("--over", options.over,
                  "NAME=FROM:TO:N, both ends included, or NAME=A,B,C: a parameter, or the initial "
                  "value of a variable (repeatable: all combinations, the last fastest)")
      ->allow_extra_args(false)
      ->type_name("NAME=FROM:TO:N");
  command
      .add_option("--let", options.lets,
                  "NAME=EXPR: a parameter or an initial value as an expression of what --over "
                  "varies, as in --over theta=0:Pi:50 --let g1=sin(theta) (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=EXPR");
  command
      .add_option("--do", options.task,
                  "What is done at each point: integrate (default); section: orbits on the level "
                  "of the point, how many are chaotic; exponents: the largest Lyapunov exponent; "
                  "indicators: MEGNO and GALI of deviations on the level of the proved integrals; "
                  "rotation: the rotation number of the point's orbit in the section")
      ->check(one_of({kIntegrate, kSection, kExponents, kIndicators, kRotation}))
      ->type_name("WHAT");
  command.add_option("--orbits", options.orbits, "Orbits of a section (default 16)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command.add_option("--points", options.points, "Crossings of each orbit (default 200)")
      ->type_name("N")
      ->check(CLI::Range(1, 10000000));
}

/// The table and its picture.
void add_output(CLI::App& command, SweepArguments& options) {
  command
      .add_option(
          "--output", options.output,
          "Write the results to this .csv, .npz, .h5 or .hdf5 file (default: CASE-sweep.csv)")
      ->type_name("FILE");
  command
      .add_option("--plot", options.plot,
                  "Draw a map: one column over a grid of two axes, the first across")
      ->type_name("FILE.svg|png|pdf");
  command
      .add_option("--colour", options.colour,
                  "The column that is drawn (default: exponent, megno, rotation, chaotic; of "
                  "integrate there is none)")
      ->type_name("COLUMN");
}

}  // namespace

void register_sweep(CLI::App& program, Action& action) {
  auto options = std::make_shared<SweepArguments>();
  CLI::App* command = program.add_subcommand(
      "sweep", "Integrate over a grid of parameters or initial states, resumably");
  command->footer(
      "Points that are done are kept beside the output until all are, and the same command goes "
      "on\n"
      "after a kill. Under mpirun the ranks share the points; the result is the same to the bit.");
  add_common(*command, options->common);
  options->start.add_to(*command);
  add_case(*command, options->case_name);
  add_study(*command, *options);
  command->add_option("--method", options->method, "A method, or auto: " + method_list())
      ->type_name("NAME");
  add_run_options(*command, options->run);
  command
      ->add_option("--observe", options->observe,
                   "States that must be computed; what they do not need is left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  command->add_option("--jobs", options->jobs, "Threads (default: all processors)")
      ->type_name("N")
      ->check(count_from_one());
  add_output(*command, *options);
  options->picture.add_to(*command);
  command->add_flag("--restart", options->restart, "Throw away the points that are done");
  command->callback([options, &action] { action = action_of(options, sweep); });
}

}  // namespace casimir::tools
