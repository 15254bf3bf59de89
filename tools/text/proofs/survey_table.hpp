#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "codegen/specialise.hpp"
#include "tools/text/proofs/proof_table.hpp"

namespace casimir::tools {

/// What specialising one scene of a case saves.
struct SceneWork {
  std::string scene;
  OperationCount general, specialised;  ///< of one right-hand side
  std::size_t states = 0, kept = 0;
};

/// One case in the survey of all.
struct SurveyRow {
  std::string case_name, book, title, phase_space;
  std::size_t dimension = 0;
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> where;  ///< what that depends on: as of `conditions_of`
  Tally claims;                    ///< those that count towards the verdict
  std::vector<std::string> scenes;
  std::optional<SceneWork> work;  ///< none for a case without scenes
};

/// In the order of the book, then by name.
void sort_by_book(std::vector<SurveyRow>& rows);

/// {"rows": [..], "failed": N}, where N counts the cases that are not proved.
nlohmann::ordered_json to_json(const std::vector<SurveyRow>& rows);

/// A table for people, and below it the totals in one line.
std::string to_text(const std::vector<SurveyRow>& rows);

/// The same as a Markdown table and a paragraph.
std::string to_markdown(const std::vector<SurveyRow>& rows);

/// One line a case; operations in four columns before and four after.
std::string to_csv(const std::vector<SurveyRow>& rows);

}  // namespace casimir::tools
