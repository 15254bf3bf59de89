#include "tools/text/proofs/survey_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/error.hpp"
#include "tools/show/book_order.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

int total(const OperationCount& count) { return count.mul + count.add + count.div + count.calls; }

struct SurveyColumn {
  std::string head;
  bool right = false;
};

const std::vector<SurveyColumn>& columns() {
  static const std::vector<SurveyColumn> kColumns{
      {"case"},         {"section"},         {"title"},
      {"phase space"},  {"variables", true}, {"proved", true},
      {"scenes", true}, {"general", true},   {"specialised", true},
      {"states", true}};
  return kColumns;
}

/// "7 of 8", but "8" where there is no difference to see.
std::string share(std::size_t part, std::size_t whole) {
  return part == whole ? fmt::format("{}", part) : fmt::format("{} of {}", part, whole);
}

std::vector<std::string> cells(const SurveyRow& row) {
  std::vector<std::string> result{row.case_name,
                                  row.book,
                                  printable(row.title, 200),
                                  printable(row.phase_space, 40),
                                  fmt::format("{}", row.dimension),
                                  fmt::format("{} of {}", row.claims.proved, row.claims.all()),
                                  fmt::format("{}", row.scenes.size())};
  if (row.work) {
    result.push_back(fmt::format("{}", total(row.work->general)));
    result.push_back(fmt::format("{}", total(row.work->specialised)));
    result.push_back(share(row.work->kept, row.work->states));
  }
  result.resize(columns().size());
  return result;
}

std::string totals(const std::vector<SurveyRow>& rows) {
  Tally claims;
  int general = 0, specialised = 0;
  for (const SurveyRow& row : rows) {
    claims.proved += row.claims.proved;
    claims.refuted += row.claims.refuted;
    claims.undecided += row.claims.undecided;
    if (row.work) {
      general += total(row.work->general);
      specialised += total(row.work->specialised);
    }
  }
  return fmt::format(
      "{} case{}; {} of {} claims proved; one right-hand side of each takes {} operations in "
      "general and {} specialised",
      rows.size(), rows.size() == 1 ? "" : "s", claims.proved, claims.all(), general, specialised);
}

/// Which cases are proved on conditions alone, a line for each.
std::string conditions(const std::vector<SurveyRow>& rows, const std::string& begin) {
  std::string text;
  for (const SurveyRow& row : rows)
    if (!row.where.empty())
      text += fmt::format("{}{} is proved{}\n", begin, row.case_name, where_text(row.where));
  return text.empty() ? "" : text + "\n";
}

/// A bar would end the cell.
std::string markdown_cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, 1, '\\');
  return text;
}

/// Powers and products are no emphasis.
std::string markdown_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '*' || c == '_') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string csv_counts(const OperationCount& count) {
  return fmt::format("{},{},{},{}", count.mul, count.add, count.div, count.calls);
}

}  // namespace

void sort_by_book(std::vector<SurveyRow>& rows) {
  std::ranges::stable_sort(rows, [](const SurveyRow& a, const SurveyRow& b) {
    if (before_in_book(a.book, b.book)) return true;
    if (before_in_book(b.book, a.book)) return false;
    return a.case_name < b.case_name;
  });
}

nlohmann::ordered_json to_json(const std::vector<SurveyRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SurveyRow& row : rows) {
    nlohmann::ordered_json json{{"case", row.case_name},
                                {"book", row.book},
                                {"title", row.title},
                                {"dimension", row.dimension},
                                {"phase_space", row.phase_space},
                                {"verdict", to_string(row.verdict)},
                                {"where", row.where},
                                {"claims",
                                 {{"counted", row.claims.all()},
                                  {"proved", row.claims.proved},
                                  {"refuted", row.claims.refuted},
                                  {"undecided", row.claims.undecided}}},
                                {"scenes", row.scenes}};
    if (row.where.empty()) json.erase("where");
    if (row.work) {
      json["scene"] = row.work->scene;
      json["operations"] = {{"general", to_json(row.work->general)},
                            {"specialised", to_json(row.work->specialised)}};
      json["states"] = {{"all", row.work->states}, {"kept", row.work->kept}};
    }
    list.push_back(json);
  }
  const auto failed = std::ranges::count_if(
      rows, [](const SurveyRow& row) { return row.verdict != Verdict::proved; });
  return {{"rows", list}, {"failed", failed}};
}

std::string to_text(const std::vector<SurveyRow>& rows) {
  constexpr std::size_t kTitle = 2, kLongestTitle = 44;
  std::vector<std::vector<std::string>> lines(1);
  for (const SurveyColumn& column : columns()) lines[0].push_back(column.head);
  for (const SurveyRow& row : rows) {
    lines.push_back(cells(row));
    lines.back()[kTitle] = printable(row.title, kLongestTitle);
  }
  std::vector<std::size_t> widths(columns().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i)
      widths[i] = std::max(widths[i], display_width(line[i]));
  }
  std::string text;
  for (const auto& line : lines) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i)
      out += (i == 0 ? "" : "  ") + padded(line[i], widths[i], columns()[i].right);
    out.erase(out.find_last_not_of(' ') + 1);
    text += out + "\n";
  }
  return text + "\n" + conditions(rows, "") + totals(rows) + "\n";
}

std::string to_markdown(const std::vector<SurveyRow>& rows) {
  std::string text = "|", rule = "|";
  for (const SurveyColumn& column : columns()) {
    text += " " + column.head + " |";
    rule += column.right ? " ---: |" : " --- |";
  }
  text += "\n" + rule + "\n";
  for (const SurveyRow& row : rows) {
    text += "|";
    for (const std::string& cell : cells(row)) text += " " + markdown_cell(cell) + " |";
    text += "\n";
  }
  return text + "\n" + markdown_text(conditions(rows, "- ")) + totals(rows) + ".\n";
}

std::string to_csv(const std::vector<SurveyRow>& rows) {
  std::string text =
      "case,book,title,dimension,phase_space,verdict,proved,refuted,undecided,scenes,scene,"
      "general_mul,general_add,general_div,general_calls,specialised_mul,specialised_add,"
      "specialised_div,specialised_calls,states,kept,where\n";
  for (const SurveyRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},", csv_field(row.case_name),
                        csv_field(row.book), csv_field(row.title), row.dimension,
                        csv_field(row.phase_space), to_string(row.verdict), row.claims.proved,
                        row.claims.refuted, row.claims.undecided, row.scenes.size());
    if (row.work)
      text +=
          fmt::format("{},{},{},{},{}", csv_field(row.work->scene), csv_counts(row.work->general),
                      csv_counts(row.work->specialised), row.work->states, row.work->kept);
    else
      text += ",,,,,,,,,,";
    text += fmt::format(",{}\n", csv_field(fmt::format("{}", fmt::join(row.where, ", "))));
  }
  return text;
}

}  // namespace casimir::tools
