#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/stress/cell.hpp"
#include "tools/tables/table.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {

/// Scenes by methods.
struct StressMatrix {
  struct Line {
    std::string case_name, scene, extreme;
    std::vector<StressCell> cells;  ///< one for each method, in their order
  };
  struct Column {
    std::string method;
    bool outside = false;
  };
  std::vector<Column> columns;
  std::vector<Line> lines;
  bool complete = true;  ///< not where the time limit came before the last cell

  /// The fastest right cell of a line; -1 where none is right.
  static int fastest(const Line& line);

  int count(Judgement verdict) const;
  int count(Refusal refusal) const;
  int failed() const;
};

/// What stands for a refusal in a table or a picture: "refused", "n/a" or "failed".
const char* refusal_word(Refusal refusal);

/// The digits of a right answer, 0 to 16.
int right_digits(const StressCell& cell);

/// A table for people: a row for each scene, and a word for each cell.
std::string to_text(const StressMatrix& matrix);

/// A line for each cell that is wrong or inaccurate, with the reason.
std::string complaints(const StressMatrix& matrix);

/// {"rows": [..], "failed": N, "complete": B, "counts": {..}}.
nlohmann::ordered_json to_json(const StressMatrix& matrix);

/// The same rows as a table, without what only a bench has.
Table table_of(const StressMatrix& matrix);

}  // namespace casimir::tools
