#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "tools/bench/comparison.hpp"
#include "tools/bench/report.hpp"
#include "tools/bench/report_html.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; color: #1a1a1a; background: #fff;
       max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.25rem; margin-top: 2.5rem; border-top: 1px solid #ccc;
     padding-top: 1rem; } h3 { font-size: 1rem; margin-bottom: .3rem; }
table { border-collapse: collapse; margin: .5rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .7rem; text-align: right; border-bottom: 1px solid #e5e5e5; }
th:first-child, td:first-child { text-align: left; }
tr.own td:first-child { font-weight: 600; }
tr.wrong td { color: #a00000; } tr.other td { color: #777; }
small { color: #666; } figure { margin: 1rem 0; } svg { max-width: 100%; height: auto; }
summary { cursor: pointer; } .scroll { overflow-x: auto; }
)";

std::string ratio_markup(double ratio) {
  return std::isnan(ratio) ? "" : fmt::format("{:.{}f}&times;", ratio, ratio < 100 ? 1 : 0);
}

std::string cell_markup(const Cell& cell) {
  if (std::isnan(cell.seconds)) return "&ndash;";
  return fmt::format("{} <small>{}</small>", duration_text(cell.seconds), ratio_markup(cell.ratio));
}

std::vector<std::string> level_heads(const std::string& first) {
  std::vector<std::string> heads{first};
  for (const double error : kErrorLevels) heads.push_back(fmt::format("{:.0e}", error));
  return heads;
}

}  // namespace

std::string html::equal_error_table(const MethodComparison& contest) {
  std::vector<std::string> heads = level_heads("method");
  heads.emplace_back("best error");
  heads.emplace_back("time for it");
  std::string rows = html::row(heads, "th");
  for (const Line& line : equal_error_lines(contest)) {
    std::vector<std::string> cells{html::text(line.contender.label())};
    for (const Cell& cell : line.levels) cells.push_back(cell_markup(cell));
    cells.push_back(fmt::format("{:.1e}", line.best.error));
    cells.push_back(cell_markup(line.best));
    rows += html::row(cells, "td", line.contender.own() ? "own" : "");
  }
  return "<h3>Time at equal error, and how many times as long as the fastest of ours</h3>\n" +
         html::table(rows);
}

std::string html::code_table(const MethodComparison& contest) {
  std::string rows = html::row(
      {"one right-hand side", "multiplications", "additions", "divisions", "calls", "states"},
      "th");
  const auto counts = [](const char* name, const OperationCount& count,
                         const std::vector<std::string>& states) {
    return html::row({name, std::to_string(count.mul), std::to_string(count.add),
                      std::to_string(count.div), std::to_string(count.calls),
                      std::to_string(states.size())});
  };
  rows += counts("general", contest.general, contest.all_states);
  rows += counts("specialised", contest.specialised, contest.states);
  std::string text = "<h3>Specialised code beside general code</h3>\n" + html::table(rows);
  const std::vector<CodeLine> lines = code_lines(contest);
  if (lines.empty()) return text;
  std::string ratios = html::row(level_heads("general takes, at error"), "th");
  for (const CodeLine& line : lines) {
    std::vector<std::string> cells{html::text(line.method)};
    for (const double ratio : line.ratios)
      cells.push_back(std::isnan(ratio) ? "&ndash;" : fmt::format("{:.2f}&times;", ratio));
    ratios += html::row(cells);
  }
  return text + html::table(ratios);
}

std::string html::rows_table(const MethodComparison& contest) {
  std::string rows = html::row({"method", "code", "tolerance", "error", "drift", "time", "spread",
                                "steps", "evaluations", "status"},
                               "th");
  for (const Row& r : contest.rows) {
    const std::string style = r.end == RowEnd::wrong ? "wrong" : r.ok() ? "" : "other";
    const std::string status = r.reason.empty() ? status_text(r) : status_text(r) + ": " + r.reason;
    rows += html::row(
        {html::text(r.method), html::text(r.code), fmt::format("{:.0e}", r.tolerance),
         std::isnan(r.error) ? "&ndash;" : fmt::format("{:.2e}", r.error),
         fmt::format("{:.1e}", r.drift), duration_text(r.seconds), duration_text(r.spread),
         std::to_string(r.steps), std::to_string(r.evaluations), html::text(status)},
        "td", style);
  }
  return "<details><summary>all rows</summary>\n" + html::table(rows) + "</details>\n";
}

namespace {

std::string section(const MethodComparison& contest, std::size_t index,
                    const std::string& picture) {
  std::string text = fmt::format(
      "<section id=\"case-{}\">\n<h2>{} <small>{}, scene {}</small></h2>\n", index,
      html::text(contest.title), html::text(contest.case_name), html::text(contest.scene));
  if (!contest.no_reference.empty())
    return text + html::paragraph("Not measured: " + contest.no_reference) + "</section>\n";
  text += html::paragraph(fmt::format("Reference: {}; its error is below {:.0e}, and {}.",
                                      contest.reference, contest.error_bound,
                                      growth_sentence(contest)));
  for (const std::string& note : contest.notes) text += html::paragraph("Note: " + note);
  text += picture.empty() ? html::paragraph("There is no picture: it needs gnuplot.")
                          : "<figure>\n" + picture + "</figure>\n";
  text += html::equal_error_table(contest);
  for (const std::string& sentence : sentences(contest)) text += html::paragraph(sentence);
  return text + html::code_table(contest) + html::rows_table(contest) + "</section>\n";
}

std::string summary_markup(const BenchReport& report) {
  std::vector<std::string> heads = level_heads("method");
  heads.emplace_back("best error it reaches");
  std::string rows = html::row(heads, "th");
  std::vector<std::string> cells;
  for (const Mean& mean : means(report.contests)) {
    if (!cells.empty() && cells.front() != html::text(mean.peer)) {
      rows += html::row(cells);
      cells.clear();
    }
    if (cells.empty()) cells.push_back(html::text(mean.peer));
    cells.push_back(mean.cases == 0
                        ? "&ndash;"
                        : fmt::format("{} <small>{} cases, least {} ({})</small>",
                                      ratio_markup(mean.ratio), mean.cases,
                                      ratio_markup(mean.least), html::text(mean.least_case)));
  }
  if (!cells.empty()) rows += html::row(cells);
  return "<h2>Summary</h2>\n<p>How many times as long as the fastest of ours others take for the "
         "same error: geometric means over the cases.</p>\n" +
         html::table(rows);
}

std::string contents(const BenchReport& report) {
  std::string text = "<ul>\n";
  for (std::size_t i = 0; i < report.contests.size(); ++i) {
    const MethodComparison& contest = report.contests[i];
    text += fmt::format("<li><a href=\"#case-{}\">{}</a>{}</li>\n", i, html::text(contest.title),
                        contest.no_reference.empty() ? "" : ": not measured");
  }
  return text + "</ul>\n";
}

}  // namespace

std::string to_html(const BenchReport& report, const std::vector<std::string>& pictures) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Error against run time</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>Error against run time</h1>\n",
      kStyle);
  text += html::paragraph(processor_text(report.machine) + "; " + report.machine.system + "; " +
                          versions_text(report.machine));
  if (report.several) text += contents(report) + summary_markup(report);
  for (std::size_t i = 0; i < report.contests.size(); ++i)
    text += section(report.contests[i], i, pictures[i]);
  return text + "</body>\n</html>\n";
}

}  // namespace casimir::tools
