// casimir stress: stiff and extreme scenes by every method; no answer may be silently wrong.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <thread>

#include "runtime/methods.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/children.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/options/picture_options.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/plot/gnuplot.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/stress/matrix.hpp"
#include "tools/stress/picture.hpp"
#include "tools/stress/transport.hpp"
#include "tools/tables/table.hpp"

namespace casimir::tools {
namespace {

struct StressArguments {
  Common common;
  std::vector<std::string> cases, methods;
  std::string tag, in, output, plot;
  PictureOptions print;
  std::optional<double> tolerance;
  double cell_limit = 5, reference_limit = 30;
  int jobs = 0;
  bool all = false, every_scene = false;
};

/// What every use of `integrate` chooses unless it is told otherwise.
constexpr const char* kAutomatic = "auto";

/// All of our own, and of the libraries beside us the multistep methods of variable order, which
/// take whatever equations come.
std::vector<std::string> default_methods() {
  std::vector<std::string> names{kAutomatic};
  for (const Method& method : methods()) {
    const bool multistep = method.header.empty() && method.order == 0;
    if (method.name != kAutomatic && !method.closed_form && !method.quadratic_only &&
        !method.free_body && (method.outside.empty() || multistep))
      names.emplace_back(method.name);
  }
  return names;
}

/// A case as `integrate` can read it by name, from standard input too.
struct Source {
  std::string path;
  CaseFile file;
  std::unique_ptr<OutputFile> copy = {};  ///< of standard input; never committed
};

Source source_of(const std::string& name, const Limits& limits) {
  if (name != "-") {
    CaseFile file = load_case(name, limits);
    const bool is_path = name.find('/') != std::string::npos;
    std::string path = is_path || !name.ends_with(".toml") ? name : "./" + name;
    return {std::move(path), std::move(file)};
  }
  const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  CaseFile file = parse_case(text, "<standard input>", limits);
  auto copy = std::make_unique<OutputFile>(std::filesystem::temp_directory_path() /
                                           "casimir-standard-input.toml");
  copy->stream() << text << std::flush;
  std::string path = copy->temporary().string();
  return {std::move(path), std::move(file), std::move(copy)};
}

/// A scene that takes part.
struct JudgedScene {
  const Source* source;
  const Model* model;
  const Scene* scene;
  SceneReference truth = {};
};

/// The command line of one cell.
std::vector<std::string> run_words(const JudgedScene& entry, const std::string& method,
                                   const StressArguments& options) {
  std::vector<std::string> words = {
      "casimir", "integrate",       entry.source->path,
      "--scene", entry.scene->name, "--method",
      method,    "--time-limit",    fmt::format("{}", options.cell_limit),
      "--json"};
  for (const LimitName& one : limit_names()) {
    if (options.common.limits.*one.value == Limits{}.*one.value) continue;
    words.emplace_back("--limit");
    words.push_back(fmt::format("{}={}", one.name, exact_text(options.common.limits.*one.value)));
  }
  if (options.tolerance) {
    words.emplace_back("--tolerance");
    words.push_back(exact_text(*options.tolerance));
  }
  if (!options.in.empty()) {
    words.emplace_back("--in");
    words.push_back(options.in);
  }
  for (const std::string& parameter : options.common.params) {
    words.emplace_back("--param");
    words.push_back(parameter);
  }
  return words;
}

/// Becomes `casimir integrate`: the judgement is on what users get.
int integrate_instead(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv("/proc/self/exe", pointers.data());
  return kEnvironment;
}

class Stress {
 public:
  explicit Stress(const StressArguments& options) : options_(options) {}

  StressMatrix run() {
    Progress progress(!options_.common.quiet);
    progress_ = &progress;
    gather();
    find_reference_states();
    fill_cells();
    matrix_.complete = !out_of_time_;
    return std::move(matrix_);
  }

 private:
  void gather() {
    for (const std::string& name :
         options_.methods.empty() ? default_methods() : options_.methods) {
      // "auto" is resolved by `integrate` alone.
      const Method& method = method_named(name);
      matrix_.columns.push_back({name, !method.outside.empty()});
    }
    if (options_.all) {
      for (const auto& path : bundled_flows(options_.tag, options_.common.limits))
        sources_.push_back({path.string(), read_case(path, options_.common.limits)});
    } else {
      for (const std::string& name : options_.cases)
        sources_.push_back(source_of(name, options_.common.limits));
    }
    for (const Source& source : sources_)
      models_.push_back(
          in_variables(model_of(source.file, options_.common.parameter_values()), options_.in));
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (options_.common.scene_given) {
        add(i, models_[i].scene(options_.common.scene));
        continue;
      }
      // Of a case that was named, and has no extreme scene, all take part.
      const bool all = options_.every_scene ||
                       (!options_.all && std::ranges::none_of(models_[i].scenes, is_extreme));
      for (const Scene& scene : models_[i].scenes)
        if ((all || is_extreme(scene)) && scene.unusable.empty()) add(i, scene);
    }
    if (entries_.empty()) throw UsageError("there is no scene to run");
  }

  static bool is_extreme(const Scene& scene) { return scene.extreme.has_value(); }

  void add(std::size_t source, const Scene& scene) {
    require_duration(scene);
    entries_.push_back({&sources_[source], &models_[source], &models_[source].scene(scene.name)});
    StressMatrix::Line line{models_[source].name,
                            scene.name,
                            scene.extreme ? to_string(*scene.extreme) : std::string{},
                            {}};
    for (const StressMatrix::Column& column : matrix_.columns) {
      StressCell cell{.row = asked(entries_.back(), column), .outside = column.outside};
      cell.row.status = Status::stopped;
      cell.row.reason = "it was not run";
      line.cells.push_back(std::move(cell));
    }
    matrix_.lines.push_back(std::move(line));
  }

  /// A row before its run.
  Row asked(const JudgedScene& entry, const StressMatrix::Column& column) const {
    return {.case_name = entry.model->name,
            .scene = entry.scene->name,
            .method = column.method,
            .tolerance = options_.tolerance.value_or(0)};
  }

  void find_reference_states() {
    progress_->begin("reference states");
    std::vector<Job> jobs;
    for (const JudgedScene& entry : entries_) {
      jobs.push_back({[this, &entry] {
                        std::cout << packed(reference_state_of_scene(*entry.model, *entry.scene,
                                                                     options_.reference_limit));
                        return 0;
                      },
                      // Two runs in double and the compiler come on top.
                      2 * options_.reference_limit + kCompiling});
    }
    run(jobs, [this](std::size_t i, const Reply& reply) {
      const nlohmann::ordered_json json = nlohmann::ordered_json::parse(reply.out, nullptr, false);
      if (json.is_discarded())
        entries_[i].truth.source = "no reference state: " + printable(reply.err, 200);
      else
        entries_[i].truth = unpacked(json);
    });
  }

  void fill_cells() {
    progress_->begin("runs");
    std::vector<Job> jobs;
    for (const JudgedScene& entry : entries_)
      for (const StressMatrix::Column& column : matrix_.columns)
        jobs.push_back(cell_job(entry, column));
    std::vector<std::size_t> again;
    run(jobs, [&](std::size_t i, const Reply& reply) {
      if (!take(i, reply)) again.push_back(i);
    });
    // A run that stopped because the compiler took its time finds the module now.
    std::vector<Job> second;
    for (const std::size_t i : again) second.push_back(jobs[i]);
    if (!again.empty())
      run(second, [&](std::size_t i, const Reply& reply) { take(again[i], reply); });
  }

  Job cell_job(const JudgedScene& entry, const StressMatrix::Column& column) const {
    return {[this, &entry, &column] {
              return integrate_instead(run_words(entry, column.method, options_));
            },
            2 * options_.cell_limit + kCompiling};
  }

  /// False: it should be tried again.
  bool take(std::size_t i, const Reply& reply) {
    const std::size_t line = i / matrix_.columns.size(), column = i % matrix_.columns.size();
    const JudgedScene& entry = entries_[line];
    const StressMatrix::Column& how = matrix_.columns[column];
    const StressAnswer answer = answer_of(reply);
    matrix_.lines[line].cells[column] =
        cell_of(asked(entry, how), how.outside, entry.truth, answer);
    return answer.kind != StressAnswer::Kind::answered || answer.status != Status::stopped ||
           answer.compile_seconds < options_.cell_limit / 4;
  }

  void run(const std::vector<Job>& jobs,
           const std::function<void(std::size_t, const Reply&)>& take_reply) {
    const int at_once = options_.jobs > 0
                            ? options_.jobs
                            : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::size_t ended = 0;
    do_jobs(
        jobs, at_once,
        [&](std::size_t i, const Reply& reply) {
          take_reply(i, reply);
          progress_->show(static_cast<double>(++ended) / static_cast<double>(jobs.size()));
        },
        [&] {
          out_of_time_ = out_of_time_ || (give_up_ && give_up_());
          return !out_of_time_;
        });
  }

  /// Seconds that a compiler may take.
  static constexpr double kCompiling = 60;

  const StressArguments& options_;
  std::function<bool()> give_up_ = time_limit(options_.common.time_limit);
  Progress* progress_ = nullptr;
  std::vector<Source> sources_;
  std::vector<Model> models_;
  std::vector<JudgedScene> entries_;
  StressMatrix matrix_;
  bool out_of_time_ = false;
};

void print_matrix(const StressMatrix& matrix) {
  std::cout << to_text(matrix) << complaints(matrix);
  fmt::print("{} cells: {} right, {} warned, {} refused, {} coarse, {} wrong",
             matrix.lines.size() * matrix.columns.size(), matrix.count(Judgement::right),
             matrix.count(Judgement::warned), matrix.count(Judgement::refused),
             matrix.count(Judgement::inaccurate), matrix.count(Judgement::wrong));
  if (matrix.count(Judgement::refused) > 0)
    fmt::print(
        " (of the refused {} as they should be, {} where the method does not apply, {} failed)",
        matrix.count(Refusal::expected), matrix.count(Refusal::not_applicable),
        matrix.count(Refusal::failed));
  if (const int unknown = matrix.count(Judgement::unknown); unknown > 0)
    fmt::print(", {} unknown", unknown);
  fmt::print("\n");
}

int stress(const StressArguments& options) {
  if (options.all == !options.cases.empty()) throw UsageError("stress needs either CASES or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (!options.plot.empty()) check_plot_name(options.plot);
  options.print.check(!options.plot.empty());
  Stress stress(options);
  const StressMatrix matrix = stress.run();
  if (!options.output.empty()) {
    write_table(options.output, table_of(matrix));
  }
  if (options.common.json)
    print_json(to_json(matrix));
  else if (!options.common.quiet)
    print_matrix(matrix);
  if (!options.plot.empty()) draw_matrix(matrix, options.print.sheet(options.plot));
  std::cout.flush();
  if (!matrix.complete)
    std::cerr << "casimir: error: the time limit was reached before every cell was run\n";
  if (matrix.failed() > 0) return kFailed;
  return matrix.complete ? kDone : kEnvironment;
}

constexpr const char* kJudgements =
    "Every cell is what 'integrate' answers, and what is said of it:\n"
    "  right    it says ok, and its error is one that the tolerance explains: at most 1000 * "
    "steps\n"
    "           * growth * (tolerance + 2^-52), where growth is how much small changes of the "
    "state\n"
    "           grow along the run, and less than a tenth of a state's size along the run\n"
    "  warned   it says that its end state is not to be trusted, which is true\n"
    "  refused  it says that it did not reach the end, and why; the table tells apart\n"
    "             refused  the motion does not reach that time: there is no other answer\n"
    "             n/a      the method is not defined for such a system, and says so\n"
    "             failed   there is an end, and it does not come to it\n"
    "  coarse   explained like that, but with less than three digits at a fine tolerance\n"
    "  wrong    it says ok, and its error is larger, or a number is not finite, or the motion "
    "does\n"
    "           not reach that time (extreme = \"blowup\" without a reference state), or it went\n"
    "           over a pole of the equations without a warning\n"
    "Errors are against the reference state of the case file or a multiprecision run. The exit\n"
    "status is 1 if a method of our own is wrong; those of other libraries are shown beside it.";

}  // namespace

void register_stress(CLI::App& program, Action& action) {
  auto options = std::make_shared<StressArguments>();
  CLI::App* command = program.add_subcommand(
      "stress", "Extreme scenes by every method: no answer may be silently wrong");
  command->footer(kJudgements);
  add_common(*command, options->common);
  add_in(*command, options->in);
  command->add_option(
      "CASE", options->cases,
      "Bundled cases, case files, or - for standard input: their extreme scenes, or "
      "all where a case has none");
  add_all(*command, options->all, options->tag, "The extreme scenes of every bundled case");
  command->add_flag("--every-scene", options->every_scene, "Scenes that are not extreme too");
  command
      ->add_option("--method", options->methods,
                   "Methods to run (default: auto, all of our own, and the multistep methods of "
                   "SUNDIALS)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B");
  command->add_option("--tolerance", options->tolerance, "Of every run (default: integrate's)")
      ->type_name("X")
      ->check(positive_number());
  command
      ->add_option("--cell-limit", options->cell_limit,
                   "Seconds for one run; what takes longer is refused (default 5)")
      ->type_name("SECONDS")
      ->check(positive_number());
  command
      ->add_option("--reference-limit", options->reference_limit,
                   "Seconds for the multiprecision run of one scene (default 30)")
      ->type_name("SECONDS")
      ->check(positive_number());
  command->add_option("--jobs", options->jobs, "Runs at a time (default: all processors)")
      ->type_name("N")
      ->check(count_from_one());
  add_csv_output(*command, options->output, "Write a row for each cell to this file");
  command->add_option("--plot", options->plot, "Draw the matrix")->type_name("FILE.svg|png|pdf");
  options->print.add_to(*command);
  command->callback([options, &action] { action = action_of(options, stress); });
}

}  // namespace casimir::tools
