// casimir survey: a table of all cases, with what is proved and what specialising saves.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <optional>

#include "codegen/specialise.hpp"
#include "tools/analysis/proof/prove_in_process.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/errors.hpp"
#include "tools/cli/json_output.hpp"
#include "tools/cli/options/choices.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/stopwatch.hpp"
#include "tools/text/files/marked_file.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/survey_table.hpp"

namespace casimir::tools {
namespace {

struct SurveyArguments {
  Common common;
  std::vector<std::string> cases;
  std::string tag, output;
  std::optional<std::string> format;
};

SceneWork work_of(const Model& model, const Scene& scene) {
  SpecialiseOptions what;
  what.invariants = what.jacobian = false;
  try {
    const Specialisation s = specialise(model, scene, what);
    return {scene.name, s.general, s.specialised, model.variables.size(), s.states.size()};
  } catch (const ModelError& problem) {
    throw ModelError(fmt::format("{}, scene '{}': {}", model.name, scene.name, problem.what()));
  }
}

SurveyRow survey_one(const CaseFile& file, const SurveyArguments& options, double seconds) {
  const Model model = model_of(file, options.common.parameter_values());
  const std::vector<Proof> proofs = prove_within(seconds, model, {}, [](const Proof&) {});
  SurveyRow row{.case_name = model.name,
                .book = model.book,
                .title = model.title,
                .phase_space = model.phase_space,
                .dimension = model.variables.size(),
                .verdict = overall(model, proofs),
                .where = conditions_of(model, proofs),
                .claims = tally_of(model, proofs),
                .scenes = {},
                .work = std::nullopt};
  for (const Scene& scene : model.scenes) row.scenes.push_back(scene.name);
  if (!model.scenes.empty() || options.common.scene_given)
    row.work = work_of(model, model.scene(options.common.scene));
  return row;
}

std::vector<CaseFile> chosen_cases(const SurveyArguments& options) {
  if (options.cases.empty()) return tagged_cases(options.tag, options.common.limits);
  if (!options.tag.empty()) throw UsageError("--tag takes no CASE");
  std::vector<CaseFile> files;
  for (const std::string& name : options.cases)
    files.push_back(load_case(name, options.common.limits));
  return files;
}

std::vector<SurveyRow> survey_rows(const std::vector<CaseFile>& files,
                                   const SurveyArguments& options) {
  const Stopwatch watch;
  Progress progress(!options.common.quiet);
  progress.begin("survey");
  std::vector<SurveyRow> rows;
  for (const CaseFile& file : files) {
    double left = 0;
    if (options.common.time_limit > 0) {
      const double spent = watch.seconds();
      left = std::max(options.common.time_limit - spent, 1e-3);
    }
    rows.push_back(survey_one(file, options, left));
    progress.show(static_cast<double>(rows.size()) / static_cast<double>(files.size()));
  }
  sort_by_book(rows);
  return rows;
}

/// The format asked for, or else the one that the name of the output tells.
std::string format_of(const SurveyArguments& options) {
  const bool markdown = options.output.ends_with(".md");
  const std::string by_name = markdown                           ? "markdown"
                              : options.output.ends_with(".csv") ? "csv"
                                                                 : "text";
  if (markdown && options.format.value_or(by_name) != by_name)
    throw UsageError(
        fmt::format("--format {} does not go into a .md file", printable(*options.format)));
  return options.format.value_or(by_name);
}

std::string formatted(const std::vector<SurveyRow>& rows, const std::string& format) {
  return format == "markdown" ? to_markdown(rows) : format == "csv" ? to_csv(rows) : to_text(rows);
}

int exit_status(const std::vector<SurveyRow>& rows) {
  const auto has = [&](Verdict verdict) {
    return std::ranges::any_of(rows, [&](const SurveyRow& row) { return row.verdict == verdict; });
  };
  return has(Verdict::refuted) ? kFailed : has(Verdict::undecided) ? kUndecided : kDone;
}

int survey(const SurveyArguments& options) {
  const std::string format = format_of(options);
  std::optional<MarkedFile> page;  // refused before any work is done for it
  if (options.output.ends_with(".md")) page.emplace(options.output, "survey");
  const std::vector<CaseFile> files = chosen_cases(options);
  if (files.empty())
    throw SystemError("no bundled cases were found; CASIMIR_CASES can name their folder");
  const std::vector<SurveyRow> rows = survey_rows(files, options);
  const std::string table = formatted(rows, format);
  if (page) {
    page->write(table);
  } else if (!options.output.empty()) {
    OutputFile file(options.output);
    file.stream() << table;
    file.commit();
  }
  if (options.common.json) {
    print_json(to_json(rows));
  } else if (!options.common.quiet) {
    if (options.output.empty())
      std::cout << table;
    else
      fmt::print("wrote {}: {} case{}\n", printable(options.output, 200), rows.size(),
                 rows.size() == 1 ? "" : "s");
  }
  return exit_status(rows);
}

}  // namespace

void register_survey(CLI::App& program, Action& action) {
  auto options = std::make_shared<SurveyArguments>();
  CLI::App* command = program.add_subcommand(
      "survey", "A table of all cases: what is proved, and the operations that specialising saves");
  add_common(*command, options->common);
  command->add_option("CASE", options->cases, "Only these cases (default: every bundled one)");
  command->add_option("--tag", options->tag, "Only bundled cases with this tag")->type_name("TAG");
  command
      ->add_option("--format", options->format,
                   "text, markdown or csv (default: by the name of --output, else text)")
      ->check(one_of({"text", "markdown", "csv"}))
      ->type_name("FORMAT");
  command
      ->add_option("--output", options->output,
                   "Write the table to this file; in a .md file only what stands between the lines "
                   "<!-- survey --> and <!-- /survey --> is replaced")
      ->type_name("FILE");
  command->callback([options, &action] { action = action_of(options, survey); });
}

}  // namespace casimir::tools
