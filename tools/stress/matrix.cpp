#include "tools/stress/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/text/runs/row_table.hpp"

namespace casimir::tools {
namespace {

constexpr Judgement kAll[] = {Judgement::right,      Judgement::warned, Judgement::refused,
                              Judgement::inaccurate, Judgement::wrong,  Judgement::unknown};

/// What stands in a cell of the table. The worst stands out without colour.
std::string word(const StressCell& cell) {
  switch (cell.verdict) {
    case Judgement::right:
      return fmt::format("{} digits", right_digits(cell));
    case Judgement::wrong:
      return "WRONG";
    case Judgement::inaccurate:
      return "coarse";
    case Judgement::refused:
      return refusal_word(cell.refusal);
    default:
      return to_string(cell.verdict);
  }
}

}  // namespace

const char* refusal_word(Refusal refusal) {
  switch (refusal) {
    case Refusal::not_applicable:
      return "n/a";
    case Refusal::failed:
      return "failed";
    default:
      return "refused";
  }
}

int StressMatrix::fastest(const Line& line) {
  int best = -1;
  for (std::size_t i = 0; i < line.cells.size(); ++i) {
    if (line.cells[i].verdict != Judgement::right) continue;
    const auto seconds = [&](int k) { return line.cells[static_cast<std::size_t>(k)].row.seconds; };
    const int here = static_cast<int>(i);
    if (best < 0 || seconds(here) < seconds(best)) best = here;
  }
  return best;
}

int StressMatrix::count(Judgement verdict) const {
  int number = 0;
  for (const Line& line : lines)
    for (const StressCell& cell : line.cells) number += cell.verdict == verdict ? 1 : 0;
  return number;
}

int StressMatrix::count(Refusal refusal) const {
  int number = 0;
  for (const Line& line : lines)
    for (const StressCell& cell : line.cells) number += cell.refusal == refusal ? 1 : 0;
  return number;
}

int StressMatrix::failed() const {
  int number = 0;
  for (const Line& line : lines)
    for (const StressCell& cell : line.cells) number += cell.row.failed ? 1 : 0;
  return number;
}

int right_digits(const StressCell& cell) {
  constexpr int kMost = 16;
  if (cell.row.error <= 0) return kMost;
  return std::clamp(static_cast<int>(std::floor(-std::log10(cell.row.error))), 0, kMost);
}

std::string to_text(const StressMatrix& matrix) {
  std::size_t label = 0;
  for (const StressMatrix::Line& line : matrix.lines)
    label = std::max(label, line.case_name.size() + line.scene.size() + 1);
  std::string text = fmt::format("{:<{}}", "", label);
  std::vector<std::size_t> widths;
  for (const StressMatrix::Column& column : matrix.columns) {
    widths.push_back(std::max<std::size_t>(column.method.size(), 9));
    text += fmt::format("  {:>{}}", column.method, widths.back());
  }
  text += '\n';
  for (const StressMatrix::Line& line : matrix.lines) {
    text += fmt::format("{:<{}}", line.case_name + " " + line.scene, label);
    for (std::size_t i = 0; i < line.cells.size(); ++i)
      text += fmt::format("  {:>{}}", word(line.cells[i]), widths[i]);
    text += '\n';
  }
  return text;
}

std::string complaints(const StressMatrix& matrix) {
  std::string text;
  for (const StressMatrix::Line& line : matrix.lines) {
    for (const StressCell& cell : line.cells) {
      if (cell.verdict != Judgement::wrong && cell.verdict != Judgement::inaccurate) continue;
      text += fmt::format("{:<10} {} {} by {}{}: {}\n", to_string(cell.verdict), line.case_name,
                          line.scene, cell.row.method, cell.outside ? " (outside)" : "",
                          cell.row.reason);
    }
  }
  return text;
}

nlohmann::ordered_json to_json(const StressMatrix& matrix) {
  std::vector<Row> rows;
  for (const StressMatrix::Line& line : matrix.lines)
    for (const StressCell& cell : line.cells) rows.push_back(cell.row);
  nlohmann::ordered_json json = to_json(rows);
  std::size_t next = 0;
  for (const StressMatrix::Line& line : matrix.lines) {
    for (const StressCell& cell : line.cells) {
      nlohmann::ordered_json& row = json["rows"][next++];
      for (const char* of_a_bench : {"code", "spread", "rounds"}) row.erase(of_a_bench);
      row["verdict"] = to_string(cell.verdict);
      if (cell.refusal != Refusal::none) row["refusal"] = to_string(cell.refusal);
      row["extreme"] = line.extreme;
      row["outside"] = cell.outside;
      if (cell.time_error) row["singular_time_error"] = exact_text(*cell.time_error);
    }
  }
  json["complete"] = matrix.complete;
  for (const Judgement verdict : kAll) json["counts"][to_string(verdict)] = matrix.count(verdict);
  return json;
}

Table table_of(const StressMatrix& matrix) {
  std::vector<Row> rows;
  std::vector<std::string> verdicts, kinds, reasons, refusals;
  for (const StressMatrix::Line& line : matrix.lines) {
    for (const StressCell& cell : line.cells) {
      rows.push_back(cell.row);
      verdicts.push_back(to_string(cell.verdict));
      kinds.push_back(line.extreme);
      reasons.push_back(cell.row.reason);
      refusals.push_back(cell.refusal == Refusal::none ? "" : to_string(cell.refusal));
    }
  }
  Table table = table_of(rows);
  std::erase_if(table.columns, [](const Column& column) {
    return column.name == "code" || column.name == "spread" || column.name == "rounds";
  });
  // A run that did not begin has no drift.
  for (Column& column : table.columns) {
    if (column.name != "drift") continue;
    std::vector<std::optional<double>> drifts;
    for (const Row& row : rows)
      drifts.push_back(std::isnan(row.drift) ? std::nullopt : std::optional(row.drift));
    column.cells = std::move(drifts);
  }
  table.columns.push_back({"verdict", std::move(verdicts)});
  table.columns.push_back({"extreme", std::move(kinds)});
  table.columns.push_back({"reason", std::move(reasons)});
  table.columns.push_back({"refusal", std::move(refusals)});
  return table;
}

}  // namespace casimir::tools
