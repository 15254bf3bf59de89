// casimir report: one page about a case, or about all of them with an index.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <thread>

#include "tools/cli/case_library.hpp"
#include "tools/cli/children.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/number_checks.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/report/index.hpp"
#include "tools/report/page.hpp"
#include "tools/report/written_page.hpp"
#include "tools/runs/atlas.hpp"
#include "tools/runs/scene_values.hpp"
#include "tools/show/book_order.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/proof_table.hpp"

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

struct ReportArguments {
  Common common;
  OtherStart start;
  std::string case_name, output, in, tag;
  bool all = false;
  double budget = -1;  ///< negative: not given
};

constexpr double kBudget = 4, kBudgetOfMany = 0.5;
constexpr double kObstruction = 1;  ///< seconds for a proof that there is no further integral

/// The text of a case file; empty where it cannot be read a second time.
std::string text_of(const CaseFile& file) {
  std::ostringstream text;
  std::ifstream stream(file.file, std::ios::binary);
  if (stream) text << stream.rdbuf();
  return text.str();
}

/// The options that change what a command is about, as they were typed.
std::vector<std::string> repeated_options(const ReportArguments& options) {
  std::vector<std::string> result;
  for (const std::string& value : options.common.params) {
    result.emplace_back("--param");
    result.push_back(value);
  }
  for (const std::string& value : options.start.words()) {
    result.emplace_back("--initial");
    result.push_back(value);
  }
  if (options.common.scene_given) result.insert(result.end(), {"--scene", options.common.scene});
  if (!options.in.empty()) result.insert(result.end(), {"--in", options.in});
  return result;
}

std::vector<std::string> drawn(const Pictures& pictures) {
  std::vector<std::string> names;
  const auto add = [&](const char* name, const std::string& svg) {
    if (!svg.empty()) names.emplace_back(name);
  };
  add("motion", pictures.motion);
  add("sphere", pictures.sphere);
  add("apex", pictures.apex);
  add("drift", pictures.drift);
  add("section", pictures.section);
  add("work-precision", pictures.work_precision);
  return names;
}

Json page_json(const Model& model, const Findings& findings, const Pictures& pictures,
               const std::string& path, double seconds) {
  const Tally tally = tally_of(model, findings.proofs);
  Json json = {
      {"case", model.name},
      {"scene", findings.scene ? Json(findings.scene->name) : Json(nullptr)},
      {"file", path},
      {"verdict", to_string(findings.verdict)},
      {"where", conditions_of(model, findings.proofs)},
      {"claims",
       {{"proved", tally.proved}, {"refuted", tally.refuted}, {"undecided", tally.undecided}}},
      {"runs", findings.runs.size() + (findings.contest ? findings.contest->rows.size() : 0)},
      {"plots", drawn(pictures)},
      {"notes", findings.notes},
      {"problems", findings.problems}};
  if (json["where"].empty()) json.erase("where");
  if (!pictures.problem.empty()) json["problems"].push_back(pictures.problem);
  json["seconds"] = seconds;
  return json;
}

/// Told what is being done for a page, and which share of it is done.
using Doing = std::function<void(const std::string& what, double share)>;

/// Investigates a case and writes its page.
WrittenPage write_report(const CaseFile& bare, const ReportArguments& options,
                         const std::string& path, PageSource source, double time_limit,
                         const Doing& doing) {
  const Stopwatch watch;
  const CaseFile file = options.start.in(bare);
  const Model model = in_variables(model_of(file, options.common.parameter_values()), options.in);
  ReportOptions what{.scene = options.common.scene, .time_limit = time_limit};
  if (!options.all) what.obstruction = kObstruction;
  what.quick = options.all && options.budget < 0;
  what.budget = options.budget >= 0 ? options.budget : options.all ? kBudgetOfMany : kBudget;
  if (options.all && !model.scenes.empty() && !options.common.scene_given)
    what.scene = model.scenes.front().name;
  what.progress = [&](const std::string& now, double share) {
    doing(model.name + ": " + now, share);
  };
  OutputFile page(path);  // refused before any work is done for it
  const Findings findings = investigate(model, what);
  const Pictures pictures = draw_pictures(file, model, findings, path);
  source.case_text = text_of(file);
  page.stream() << report_page(model, findings, pictures, source);
  page.commit();
  WrittenPage written{.entry = entry_of(model, findings, pictures.thumbnail,
                                        std::filesystem::path(path).filename()),
                      .json = page_json(model, findings, pictures, path, watch.seconds()),
                      .status = findings.exit_status(),
                      .problems = findings.problems};
  if (!pictures.problem.empty()) {
    written.problems.push_back(pictures.problem);
    if (written.status == kDone) written.status = kEnvironment;
  }
  if (findings.stopped && written.status == kDone) written.status = kEnvironment;
  return written;
}

void say_problems(const std::vector<std::string>& problems) {
  std::set<std::string> said;
  for (const std::string& problem : problems)
    if (said.insert(problem).second) std::cerr << "casimir: error: " << problem << '\n';
}

int report_one(const ReportArguments& options) {
  const CaseFile file = load_case(options.case_name, options.common.limits);
  const std::string of_case = options.case_name == "-" ? "report" : file.name;
  const std::string path = options.output.empty() ? of_case + ".html" : options.output;
  if (!is_page_name(path))
    throw UsageError(fmt::format("'{}': a report's name must end in .html", printable(path, 200)));
  Progress progress(!options.common.quiet);
  std::string before;
  const WrittenPage written = write_report(
      file, options, path, {options.case_name, repeated_options(options), {}, {}, {}, {}},
      options.common.time_limit, [&](const std::string& what, double share) {
        if (what != before) progress.begin(what);
        before = what;
        progress.show(share);
      });
  if (options.common.json) {
    print_json(written.json);
  } else if (!options.common.quiet) {
    fmt::print("wrote {}: {}{}, {}\n", printable(path, 200), to_string(written.entry.verdict),
               where_text(written.entry.where), written.entry.claims);
    for (const auto& note : written.json.at("notes"))
      fmt::print("  note: {}\n", note.get<std::string>());
  }
  std::cout.flush();
  say_problems(written.problems);
  return written.status;
}

/// Where the index and the pages go.
struct Place {
  std::filesystem::path folder, index;
};

Place place_of(const ReportArguments& options) {
  const std::filesystem::path output = options.output.empty() ? "report" : options.output;
  const Place place = is_page_name(output.string()) ? Place{output.parent_path(), output}
                                                    : Place{output, output / "index.html"};
  std::error_code problem;
  if (!place.folder.empty()) std::filesystem::create_directories(place.folder, problem);
  if (problem)
    throw SystemError(fmt::format("cannot make the folder '{}': {}",
                                  printable(place.folder.string(), 200), problem.message()));
  return place;
}

std::vector<CaseFile> ordered_cases(const ReportArguments& options) {
  std::vector<CaseFile> files = tagged_cases(options.tag, options.common.limits);
  if (files.empty())
    throw SystemError("no bundled cases were found; CASIMIR_CASES can name their folder");
  std::ranges::stable_sort(
      files, [](const CaseFile& a, const CaseFile& b) { return before_in_book(a.book, b.book); });
  return files;
}

/// A case that has no report, with the reason.
IndexEntry without_page(const CaseFile& file, const std::string& problem) {
  return {.case_name = file.name, .book = file.book, .title = file.title, .problem = problem};
}

int worst(int a, int b) {
  for (const int status : {kFailed, kBadInput, kEnvironment, kUndecided})
    if (a == status || b == status) return status;
  return kDone;
}

/// The pages of all cases, each made by a process of its own, and the index over them.
class Reports {
 public:
  Reports(const ReportArguments& options, std::vector<CaseFile> files)
      : options_(options),
        files_(std::move(files)),
        place_(place_of(options)),
        progress_(!options.common.quiet),
        pages_(files_.size()) {
    for (const CaseFile& file : files_) {
      if (page_of(file) == place_.index)
        throw UsageError(fmt::format("--output '{}' would be the page of the case '{}'",
                                     printable(options.output, 200), file.name));
    }
  }

  int write() {
    constexpr double kLongest = 3600;
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < files_.size(); ++i)
      jobs.push_back({[this, i] {
                        std::cout << to_json(made(i)).dump();
                        return 0;
                      },
                      kLongest, true});
    progress_.begin("reports");
    const int at_once = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    std::size_t ended = 0;
    do_jobs(jobs, at_once, [&](std::size_t i, const Reply& reply) {
      take(i, reply);
      progress_.name(files_[i].name);
      progress_.show(static_cast<double>(++ended) / static_cast<double>(files_.size()));
      say(pages_[i].entry);
    });
    return end();
  }

 private:
  std::filesystem::path page_of(const CaseFile& file) const {
    return place_.folder / (file.name + ".html");
  }

  PageSource source_of(std::size_t i) const {
    PageSource source{
        files_[i].name, repeated_options(options_), {}, place_.index.filename().string(), {}, {}};
    if (i > 0) source.before = page_of(files_[i - 1]).filename();
    if (i + 1 < files_.size()) source.after = page_of(files_[i + 1]).filename();
    return source;
  }

  /// In a process of its own: the page, or why there is none.
  WrittenPage made(std::size_t i) const {
    const CaseFile& file = files_[i];
    double left = 0;
    if (options_.common.time_limit > 0)
      left = std::max(options_.common.time_limit - watch_.seconds(), 1e-3);
    try {
      return write_report(file, options_, page_of(file).string(), source_of(i), left,
                          [](const std::string& /*what*/, double /*share*/) {});
    } catch (const CaseError& problem) {
      return without(i, problem.what(), kBadInput);
    } catch (const ModelError& problem) {
      return without(i, problem.what(), kBadInput);
    }
  }

  /// The pages beside lead here: so there is one that says what is the matter.
  WrittenPage without(std::size_t i, const std::string& problem, int status) const {
    const CaseFile& file = files_[i];
    OutputFile page(page_of(file));
    page.stream() << page_without_report(file.title.empty() ? file.name : file.title, problem,
                                         source_of(i));
    page.commit();
    return {without_page(file, problem), {{"case", file.name}, {"problem", problem}}, status, {}};
  }

  /// A process that died, whatever it did, costs its own page.
  void take(std::size_t i, const Reply& reply) {
    if (reply.exit == 0) {
      pages_[i] = written_page_from_json(Json::parse(reply.out));
      return;
    }
    std::string problem = reply.err.substr(0, reply.err.find('\n'));
    if (problem.empty())
      problem = reply.killed ? "making the page took more than an hour"
                             : "the process that made the page died";
    pages_[i] = without(i, problem, kEnvironment);
    pages_[i].problems.push_back(fmt::format("{}: {}", files_[i].name, problem));
  }

  void say(const IndexEntry& entry) const {
    if (options_.common.quiet || options_.common.json) return;
    fmt::print("{:<10} {:<32} {}\n", entry.problem.empty() ? to_string(entry.verdict) : "no page",
               entry.case_name, entry.problem.empty() ? entry.claims : entry.problem);
    std::fflush(stdout);
  }

  int end() {
    std::vector<IndexEntry> entries;
    std::vector<std::string> problems;
    Json cases = Json::array();
    int status = kDone;
    for (const WrittenPage& page : pages_) {
      entries.push_back(page.entry);
      cases.push_back(page.json);
      problems.insert(problems.end(), page.problems.begin(), page.problems.end());
      status = worst(status, page.status);
    }
    OutputFile index(place_.index);
    index.stream() << index_page(entries, this_machine());
    index.commit();
    if (options_.common.json) {
      print_json(
          Json{{"cases", cases}, {"index", place_.index.string()}, {"seconds", watch_.seconds()}});
    } else if (!options_.common.quiet) {
      fmt::print("wrote {}: {} cases\n", printable(place_.index.string(), 200), entries.size());
    }
    std::cout.flush();
    say_problems(problems);
    return status;
  }

  const ReportArguments& options_;
  const std::vector<CaseFile> files_;
  Place place_;
  Progress progress_;
  Stopwatch watch_;
  std::vector<WrittenPage> pages_;
};

int report_all(const ReportArguments& options) {
  return Reports(options, ordered_cases(options)).write();
}

int report(const ReportArguments& options) {
  if (options.all == !options.case_name.empty())
    throw UsageError("report needs either a CASE or --all");
  if (!options.all && !options.tag.empty()) throw UsageError("--tag needs --all");
  if (options.all && (!options.in.empty() || !options.common.params.empty()))
    throw UsageError("--in and --param need a CASE");
  return options.all ? report_all(options) : report_one(options);
}

}  // namespace

void register_report(CLI::App& program, Action& action) {
  auto options = std::make_shared<ReportArguments>();
  CLI::App* command = program.add_subcommand(
      "report", "One page about a case: equations, proofs, code, drift, error against run time");
  command->footer(
      "The page needs nothing but itself. The exit status is that of what it reports: 1 if a "
      "claim\n"
      "is refuted or an invariant drifts, 3 if a claim is undecided, 4 if something is missing.");
  add_common(*command, options->common);
  add_in(*command, options->in);
  options->start.add_to(*command);
  command->add_option("CASE", options->case_name, kCaseText);
  add_all(*command, options->all, options->tag, "Every bundled case, and an index over them");
  command
      ->add_option(
          "--budget", options->budget,
          "Seconds of measuring error against run time (default 4; with --all 0.5 a case, without "
          "libraries that take longer to compile than to measure); 0 leaves it out")
      ->type_name("SECONDS")
      ->check(number_from_zero());
  command
      ->add_option("--output", options->output,
                   "The page (default: CASE.html, or report.html of standard input); with --all a "
                   "folder (default: report), or the "
                   "index page, beside which the others stand")
      ->type_name("FILE.html");
  command->callback([options, &action] { action = action_of(options, report); });
}

}  // namespace casimir::tools
