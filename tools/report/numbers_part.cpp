// What of a report is measured: code, motion, drift, run times, the machine.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "tools/bench/comparison.hpp"
#include "tools/bench/report.hpp"
#include "tools/bench/report_html.hpp"
#include "tools/report/page.hpp"
#include "tools/text/files/generated_report.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

std::string figure(const std::string& svg, const std::string& id, const std::string& caption) {
  if (svg.empty()) return "";
  return fmt::format(
      "<figure id=\"figure-{0}\" role=\"group\" aria-labelledby=\"caption-{0}\">\n{1}<figcaption "
      "id=\"caption-{0}\">{2}</figcaption>\n</figure>\n",
      id, svg, html::text(caption));
}

std::string missing_picture(const Pictures& pictures) {
  return pictures.problem.empty() ? ""
                                  : html::paragraph("There is no picture: " + pictures.problem);
}

std::string operations(const std::string& name, const OperationCount& count,
                       const std::string& more = {}) {
  return html::row({html::text(name), std::to_string(count.mul), std::to_string(count.add),
                    std::to_string(count.div), std::to_string(count.calls), more});
}

std::string left_out(const Specialisation& code) {
  if (code.left_out.empty()) return "<p>Nothing was left out.</p>\n";
  std::string rows = html::row({"left out", "", "because"}, "th");
  for (const LeftOut& item : code.left_out)
    rows += html::row({html::text(item.kind), html::text(item.name), html::text(item.reason)});
  return "<div class=\"words\">" + html::table(rows) + "</div>\n";
}

std::string status_of(const Row& row) {
  return row.reason.empty() ? status_text(row) : status_text(row) + ": " + row.reason;
}

std::string size_or_dash(double value) {
  return std::isnan(value) ? "&ndash;" : fmt::format("{:.1e}", value);
}

}  // namespace

std::string code_part(const Findings& findings) {
  if (!findings.code) return "";
  const Specialisation& code = *findings.code;
  std::string text = "<section id=\"code\">\n<h2>What was generated, and what was left out</h2>\n";
  text += html::paragraph(fmt::format(
      "Scene {}, states {}{}.", code.scene, fmt::join(code.states, ", "),
      code.parameters.empty()
          ? ""
          : fmt::format("; parameters at run time: {}", fmt::join(code.parameters, ", "))));
  std::string rows = html::row(
      {"operations", "multiplications", "additions", "divisions", "calls", "entries"}, "th");
  rows += operations("right-hand side, as in the case file", code.general);
  rows += operations("right-hand side, specialised", code.specialised);
  const std::size_t n = code.states.size(), invariants = code.invariant_names.size();
  if (invariants > 0)
    rows += operations(fmt::format("invariants {}", fmt::join(code.invariant_names, ", ")),
                       count_operations(code.invariants));
  const auto matrix = [&](const char* name, const SparseProgram& program, std::size_t size) {
    rows += operations(name, count_operations(program.program),
                       fmt::format("{} of {}", program.entries.size(), size));
  };
  if (code.has_gradients && invariants > 0)
    matrix("gradients of the invariants", code.gradients, n * invariants);
  if (code.has_jacobian) matrix("Jacobian", code.jacobian, n * n);
  return text + html::table(rows) + left_out(code) + "</section>\n";
}

std::string motion_part(const Findings& findings, const Pictures& pictures) {
  if (!findings.motion) return "";
  std::string text = "<section id=\"motion\">\n<h2>The motion</h2>\n";
  if (pictures.motion.empty()) text += missing_picture(pictures);
  text += figure(
      pictures.motion, "motion",
      fmt::format("States against time: scene {}, by {}; the first part of a run to t = "
                  "{:.6g}.",
                  findings.scene->name, findings.motion_method, findings.motion->times.back()));
  text += "<div class=\"pair\">\n";
  text +=
      figure(pictures.sphere, "sphere",
             "A vector of constant length on its sphere, in the axes of the body. What is behind "
             "is dotted.");
  text +=
      figure(pictures.apex, "apex",
             "The apex of the body: its third axis in space, the vertical upwards. What is behind "
             "is dotted.");
  return text + "</div>\n</section>\n";
}

std::string drift_part(const Findings& findings, const Pictures& pictures) {
  if (findings.runs.empty()) return "";
  std::string text = "<section id=\"drift\">\n<h2>How well the invariants are kept</h2>\n";
  text += html::paragraph(conservation_sentence(findings.runs, findings.drift_bound) + ".");
  text += missing_picture(pictures);
  text += figure(
      pictures.drift, "drift",
      fmt::format("Drift against time, scene {}, at tolerance 1e-12.", findings.scene->name));
  std::string rows =
      html::row({"scene", "method", "drift", "error", "time", "steps", "status"}, "th");
  for (const Row& r : findings.runs) {
    rows += html::row(
        {html::text(r.scene), html::text(r.method), size_or_dash(r.drift), size_or_dash(r.error),
         duration_text(r.seconds), std::to_string(r.steps), html::text(status_of(r))},
        "td",
        r.failed    ? "wrong"
        : r.refused ? "other"
                    : "");
  }
  return text + "<div class=\"words2\">" + html::table(rows) + "</div></section>\n";
}

std::string section_part(const Model& model, const Pictures& pictures) {
  if (!model.section || pictures.section.empty()) return "";
  return "<section id=\"section\">\n<h2>Poincar&eacute; section</h2>\n" +
         figure(pictures.section, "section", pictures.section_caption) + "</section>\n";
}

std::string work_precision_part(const Findings& findings, const Pictures& pictures) {
  if (!findings.contest) return "";
  const MethodComparison& contest = *findings.contest;
  std::string text = "<section id=\"work-precision\">\n<h2>Error against run time</h2>\n";
  text += html::paragraph(
      fmt::format("Scene {}. Reference: {}; its error is below {:.0e}, and {}. Libraries beside "
                  "ours are dashed, "
                  "with open marks.",
                  contest.scene, contest.reference, contest.error_bound, growth_sentence(contest)));
  text += missing_picture(pictures);
  text += figure(pictures.work_precision, "work-precision",
                 "Run time against the error at the end: further left and down is better.");
  text += html::equal_error_table(contest);
  for (const std::string& sentence : sentences(contest)) text += html::paragraph(sentence);
  for (const std::string& note : contest.notes) text += html::paragraph("Note: " + note);
  return text + "</section>\n";
}

std::string runs_part(const Findings& findings) {
  if (!findings.contest) return "";
  return "<section id=\"runs\">\n<h2>The runs</h2>\n" + html::code_table(*findings.contest) +
         html::rows_table(*findings.contest) + "</section>\n";
}

std::string machine_part(const Findings& findings) {
  const Machine& machine = findings.machine;
  std::string text = "<section id=\"machine\">\n<h2>Versions and machine</h2>\n<dl>\n";
  const auto entry = [&](const std::string& name, const std::string& value) {
    text += "<dt>" + html::text(name) + "</dt><dd>" + html::text(value) + "</dd>\n";
  };
  entry("processor", processor_text(machine));
  entry("system", machine.system);
  for (const auto& [name, version] : machine.versions) entry(name, version);
  return text + "</dl>\n</section>\n";
}

}  // namespace casimir::tools
