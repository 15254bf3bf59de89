#include "tools/report/index.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tools/bench/comparison.hpp"
#include "tools/report/page.hpp"
#include "tools/report/script/script.hpp"
#include "tools/show/book_order.hpp"
#include "tools/text/proofs/proof_report.hpp"
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

int all_operations(const OperationCount& count) {
  return static_cast<int>(count.mul + count.add + count.div + count.calls);
}

/// The part of the book that a section belongs to: "Chapter 2", "Appendix G".
std::string chapter_of(const std::string& book) {
  if (book.empty()) return "Beside the book";
  const std::string part = book.substr(0, book.find('.'));
  const bool is_chapter = std::isdigit(static_cast<unsigned char>(part[0])) != 0;
  return (is_chapter ? "Chapter " : "Appendix ") + part;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// What is told of a case in small letters.
std::string measures(const IndexEntry& entry) {
  std::vector<std::string> parts;
  if (entry.general)
    parts.push_back(fmt::format("{} → {} operations", all_operations(*entry.general),
                                all_operations(*entry.specialised)));
  if (entry.drift >= 0) parts.push_back(fmt::format("drift {:.0e}", entry.drift));
  if (!entry.fastest.empty()) parts.push_back("1e-9: " + entry.fastest);
  return html::text(fmt::format("{}", fmt::join(parts, "; ")), 400);
}

std::string card(const IndexEntry& entry) {
  const std::string name = html::text(entry.title.empty() ? entry.case_name : entry.title);
  const std::string title =
      entry.link.empty() ? name : "<a href=\"" + html::text(entry.link) + "\">" + name + "</a>";
  std::string text = fmt::format(
      "<li class=\"card\" data-words=\"{}\">\n<div class=\"small\">{}</div>\n<div><h3>{}</h3>\n"
      "<p class=\"soft\">{}{}{}</p>\n",
      html::text(lower(fmt::format("{} {} {} {} {} {}", entry.title, entry.case_name,
                                   book_text(entry.book), entry.phase_space, entry.tags,
                                   entry.problem.empty() ? to_string(entry.verdict) : "")),
                 2000),
      entry.thumbnail, title, html::text(entry.case_name),
      entry.book.empty() ? "" : ", " + html::text(book_text(entry.book)),
      entry.phase_space.empty() ? "" : ", " + html::text(entry.phase_space));
  if (!entry.problem.empty()) return text + html::paragraph(entry.problem) + "</div></li>\n";
  text += fmt::format("<p><span class=\"badge {}\">{}</span>{} <small>{}</small></p>\n",
                      to_string(entry.verdict), verdict_mark(entry.verdict),
                      html::text(where_text(entry.where), 400), html::text(entry.claims));
  return text + "<p class=\"soft\"><small>" + measures(entry) + "</small></p></div></li>\n";
}

/// The cases of each chapter, in the order of the entries.
std::string chapters(const std::vector<IndexEntry>& entries) {
  std::string text, open;
  for (const IndexEntry& entry : entries) {
    const std::string chapter = chapter_of(entry.book);
    if (chapter != open)
      text += (open.empty() ? "" : "</ul></section>\n") +
              fmt::format("<section class=\"chapter\"><h2>{}</h2>\n<ul class=\"cards\">\n",
                          html::text(chapter));
    open = chapter;
    text += card(entry);
  }
  return text + (open.empty() ? "" : "</ul></section>\n");
}

}  // namespace

IndexEntry entry_of(const Model& model, const Findings& findings, const std::string& thumbnail,
                    const std::string& link) {
  IndexEntry entry{.case_name = model.name,
                   .book = model.book,
                   .title = model.title,
                   .phase_space = model.phase_space,
                   .tags = fmt::format("{}", fmt::join(model.tags, " ")),
                   .thumbnail = thumbnail,
                   .link = link,
                   .verdict = findings.verdict,
                   .where = conditions_of(model, findings.proofs),
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
  return page_head("casimir: all cases", "Reports on all cases") +
         "<header>\n<h1>All cases</h1>\n" +
         html::paragraph(fmt::format("{} cases, {} of them proved in all they claim. {}; {}.",
                                     entries.size(), proved, processor_text(machine),
                                     versions_text(machine))) +
         "<p hidden><label>Search <input type=\"search\" id=\"search\" "
         "autocomplete=\"off\"></label> <span id=\"search-words\" role=\"status\"></span></p>\n"
         "</header>\n<main>\n" +
         chapters(entries) + "</main>\n" +
         page_end(std::string("<script>") + kIndexScript + "</script>\n");
}

}  // namespace casimir::tools
