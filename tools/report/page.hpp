#pragma once

#include <string>
#include <vector>

#include "tools/report/findings.hpp"
#include "tools/report/pictures.hpp"

namespace casimir::tools {

/// What a page says of itself.
struct PageSource {
  std::string argument;              ///< the CASE as it was typed
  std::vector<std::string> options;  ///< --param and the like, as they were typed
  std::string case_text;             ///< of the case file, or empty
  std::string index;                 ///< relative link to the index, or empty
};

/// One page that needs nothing else: no script, no request.
std::string report_page(const Model& model, const Findings& findings, const Pictures& pictures,
                        const PageSource& source);

/// "✓ proved": a mark, and the word beside it.
std::string verdict_mark(Verdict verdict);

/// The beginning of a page up to <main>, and its end.
std::string page_head(const std::string& title, const std::string& description);
std::string page_end();

// Its sections, each with a heading; empty where there is nothing to tell.
std::string system_part(const Model& model);
std::string claims_part(const Model& model, const Findings& findings);
std::string code_part(const Findings& findings);
std::string motion_part(const Findings& findings, const Pictures& pictures);
std::string drift_part(const Findings& findings, const Pictures& pictures);
std::string section_part(const Model& model, const Pictures& pictures);
std::string work_precision_part(const Findings& findings, const Pictures& pictures);
std::string runs_part(const Findings& findings);
std::string machine_part(const Findings& findings);
std::string reproduce_part(const Model& model, const Findings& findings, const PageSource& source);

}  // namespace casimir::tools
