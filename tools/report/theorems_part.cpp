// What of a report is proved about numbers: the state at the end, and cycles.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/report/page.hpp"
#include "tools/text/runs/enclosure_report.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

std::string ends_text(const RationalInterval& interval, int digits) {
  const auto [low, high] = decimal_ends(interval, digits);
  return fmt::format("[{}, {}]", low, high);
}

std::string enclosure_of(const Findings& findings) {
  const ValidatedMotion& motion = *findings.enclosure;
  const ValidatedRun& run = motion.run;
  const EnclosureReport report{.motion = motion, .digits = {}, .seconds = run.seconds};
  constexpr int kDigits = 17;
  std::string text = html::paragraph(fmt::format(
      "Theorem. For the exact data of the scene {} the solution exists up to t = {}, and its state "
      "is then in this box{}.",
      findings.scene->name, report.time(),
      run.contracted_by.empty() ? std::string()
                                : fmt::format(", made smaller by {}, proved to be constant",
                                              fmt::join(run.contracted_by, ", "))));
  if (run.status != ValidatedStatus::ok)
    text += html::paragraph("Beyond that time nothing is proved: " + run.reason + ".");
  std::string rows = html::row({"state", "is in"}, "th");
  for (std::size_t i = 0; i < motion.names.size(); ++i)
    rows += html::row({html::text(motion.names[i]), ends_text(run.end.states[i], kDigits)});
  return text + html::table(rows);
}

std::string cycles_of(const Model& model, const Findings& findings) {
  std::string text = html::paragraph(fmt::format(
      "Theorem. On the level {} there is exactly one periodic orbit of its period near each of "
      "these points of the plane of the section.",
      findings.cycle_level));
  std::vector<std::string> head{"period", "trace", "kind"};
  for (const GiNaC::symbol& x : model.variables) head.push_back(html::text(x.get_name()));
  std::string rows = html::row(head, "th");
  constexpr int kDigits = 12;
  for (const ProvedCycle& cycle : findings.cycles) {
    std::vector<std::string> row{ends_text(cycle.period, kDigits), ends_text(cycle.trace, 7),
                                 cycle.kind()};
    for (const RationalInterval& x : cycle.state) row.push_back(ends_text(x, kDigits));
    rows += html::row(row);
  }
  return text + "<div class=\"words2\">" + html::table(rows) + "</div>\n";
}

}  // namespace

std::string theorems_part(const Model& model, const Findings& findings) {
  if (!findings.enclosure && findings.cycles.empty()) return "";
  std::string text = "<section id=\"theorems\">\n<h2>What is proved of the numbers</h2>\n";
  if (findings.enclosure) text += enclosure_of(findings);
  if (!findings.cycles.empty()) text += cycles_of(model, findings);
  return text + "</section>\n";
}

}  // namespace casimir::tools
