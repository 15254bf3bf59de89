#include "tools/report/index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/bench/comparison.hpp"
#include "tools/report/page.hpp"
#include "tools/show/book_order.hpp"
#include "tools/text/proofs/proof_table.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

/// The fastest of ours to an error of 1e-9.
std::string fastest_of(const MethodComparison& contest) {
  constexpr double kLevel = 1e-9;
  for (const Line& line : equal_error_lines(contest)) {
    for (const Cell& cell : line.levels) {
      if (cell.error == kLevel && !cell.fastest.empty())
        return cell.fastest + ", " + duration_text(cell.fastest_seconds);
    }
  }
  return "";
}

int total(const OperationCount& count) {
  return static_cast<int>(count.mul + count.add + count.div + count.calls);
}

std::string line(const IndexEntry& entry) {
  const std::string name = html::text(entry.title.empty() ? entry.case_name : entry.title);
  const std::string title =
      entry.link.empty() ? name : "<a href=\"" + html::text(entry.link) + "\">" + name + "</a>";
  const std::string head =
      fmt::format("<td>{}<br><small>{}{}</small></td>", title, html::text(entry.case_name),
                  entry.book.empty() ? "" : ", " + html::text(book_text(entry.book)));
  if (!entry.problem.empty())
    return "<tr>" + head + "<td colspan=\"5\">" + html::text(entry.problem) + "</td></tr>\n";
  const std::string operations =
      entry.general ? fmt::format("{} &rarr; {}", total(*entry.general), total(*entry.specialised))
                    : "&ndash;";
  return fmt::format(
      "<tr>{}<td class=\"{}\">{}<br><small>{}</small></td><td class=\"less\">{}</td>"
      "<td class=\"less\">{}</td><td class=\"less\">{}</td><td class=\"less\">{}</td></tr>\n",
      head, to_string(entry.verdict), verdict_mark(entry.verdict), html::text(entry.claims),
      html::text(entry.phase_space), operations,
      entry.drift < 0 ? "&ndash;" : fmt::format("{:.0e}", entry.drift),
      entry.fastest.empty() ? "&ndash;" : html::text(entry.fastest));
}

}  // namespace

IndexEntry entry_of(const Model& model, const Findings& findings, const std::string& link) {
  IndexEntry entry{.case_name = model.name,
                   .book = model.book,
                   .title = model.title,
                   .phase_space = model.phase_space,
                   .link = link,
                   .verdict = findings.verdict,
                   .claims = tally_of(model, findings.proofs).text()};
  if (findings.code) {
    entry.general = findings.code->general;
    entry.specialised = findings.code->specialised;
  }
  for (const Row& row : findings.runs)
    if (!row.refused) entry.drift = std::max(entry.drift, row.drift);
  if (findings.contest) entry.fastest = fastest_of(*findings.contest);
  return entry;
}

std::string index_page(const std::vector<IndexEntry>& entries, const Machine& machine) {
  std::size_t proved = 0;
  for (const IndexEntry& entry : entries)
    proved += entry.problem.empty() && entry.verdict == Verdict::proved ? 1 : 0;
  std::string rows =
      "<tr><th>case</th><th>claims</th><th class=\"less\">phase space</th><th class=\"less\">"
      "operations, general &rarr; specialised</th><th class=\"less\">largest drift</th><th "
      "class=\"less\">fastest to 1e-09</th></tr>\n";
  for (const IndexEntry& entry : entries) rows += line(entry);
  return page_head("casimir: all cases", "Reports on all cases") +
         "<header>\n<h1>All cases</h1>\n" +
         html::paragraph(fmt::format("{} cases, {} of them proved in all they claim. {}; {}.",
                                     entries.size(), proved, processor_text(machine),
                                     versions_text(machine))) +
         "</header>\n<main>\n<div class=\"words\">" + html::table(rows) + "</div>\n</main>\n" +
         page_end();
}

}  // namespace casimir::tools
