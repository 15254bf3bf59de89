#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/benchmark/method_comparison.hpp"
#include "tools/cli/machine.hpp"
#include "tools/plot/plot.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {

/// All that a bench has found out.
struct BenchReport {
  std::vector<MethodComparison> contests = {};
  Machine machine = {};
  bool several = false;  ///< cases were asked for: there is a summary over them

  std::vector<Row> rows() const;
};

/// Rows, ratios and where the reference is from; with `several` a list of cases and a summary.
nlohmann::ordered_json to_json(const BenchReport& report);

/// For people. The rows of a case only where it is the only one.
std::string to_text(const BenchReport& report);

/// The tables alone, for a README.
std::string to_markdown(const BenchReport& report);

/// One page that needs nothing else: tables of every case, and pictures.
/// \param pictures  an SVG document for each contest, or empty where there is none.
std::string to_html(const BenchReport& report, const std::vector<std::string>& pictures);

/// Error against run time: a curve for each contender, rows that are not good left out. Libraries
/// beside us are dashed; general code is in small marks on the curve of its method.
Plot picture_of(const MethodComparison& contest);

/// "6 multiplications, 1 addition, 0 divisions, 0 calls".
std::string operations_text(const OperationCount& count);

}  // namespace casimir::tools
