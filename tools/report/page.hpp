#pragma once

#include <string>
#include <vector>

#include "tools/report/findings.hpp"
#include "tools/report/live_system.hpp"
#include "tools/report/pictures.hpp"

namespace casimir::tools {

/// What a page says of itself.
struct PageSource {
  std::string argument;              ///< the CASE as it was typed
  std::vector<std::string> options;  ///< --param and the like, as they were typed
  std::string case_text;             ///< of the case file, or empty
  std::string index;                 ///< relative link to the index, or empty
  std::string before, after;         ///< relative links to other cases, or empty
};

/// One page that needs nothing else and makes no request. With its script it integrates, and
/// pictures tell values; without, everything else is there.
std::string report_page(const Model& model, const Findings& findings, const Pictures& pictures,
                        const PageSource& source);

/// The page of a case that has no report, with the reason.
std::string page_without_report(const std::string& title, const std::string& problem,
                                const PageSource& source);

/// "✓ proved": a mark, and the word beside it.
std::string verdict_mark(Verdict verdict);

/// The beginning of a page up to <main>, and its end.
std::string page_head(const std::string& title, const std::string& description);
/// \param script  of the page, as an element, or empty
std::string page_end(const std::string& script);

// Its sections, each with a heading; empty where there is nothing to tell.
std::string system_part(const Model& model);
std::string claims_part(const Model& model, const Findings& findings);
/// What the script of the page integrates, as an element with data.
/// \param motion  the same, which is shown until the script has its own
/// \param command  that does the same on the command line
std::string live_part(const LiveSystem& live, const Motion& motion, const std::string& scene,
                      const std::string& command);
/// The script of a report.
std::string page_script();
std::string code_part(const Findings& findings);
std::string motion_part(const Findings& findings, const Pictures& pictures);
std::string theorems_part(const Model& model, const Findings& findings);
std::string drift_part(const Findings& findings, const Pictures& pictures);
std::string section_part(const Model& model, const Pictures& pictures);
std::string work_precision_part(const Findings& findings, const Pictures& pictures);
std::string runs_part(const Findings& findings);
std::string machine_part(const Findings& findings);
std::string reproduce_part(const Model& model, const Findings& findings, const PageSource& source);

}  // namespace casimir::tools
