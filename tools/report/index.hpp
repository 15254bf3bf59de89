#pragma once

#include <string>
#include <vector>

#include "tools/cli/machine.hpp"
#include "tools/report/findings.hpp"

namespace casimir::tools {

/// A line of the index.
struct IndexEntry {
  std::string case_name = {}, book = {}, title = {}, phase_space = {}, tags = {};
  std::string thumbnail = {};  ///< an SVG element, or empty
  std::string link = {};       ///< relative; empty where there is no page
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> where{};  ///< what that depends on
  std::string claims = {};           ///< "12 proved, 0 refuted, 0 undecided"
  std::optional<OperationCount> general = {}, specialised = {};
  double drift = -1;         ///< largest; negative: nothing was integrated
  std::string fastest = {};  ///< to an error of 1e-9: "taylor, 43 us"
  std::string problem = {};  ///< why there is no page
};

IndexEntry entry_of(const Model& model, const Findings& findings, const std::string& thumbnail,
                    const std::string& link);

/// The page over all cases: by chapters of the book, with a picture each and a box to search in.
std::string index_page(const std::vector<IndexEntry>& entries, const Machine& machine);

}  // namespace casimir::tools
