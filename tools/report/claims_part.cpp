// The claims of a report with their verdicts.
#include <fmt/format.h>

#include "tools/report/page.hpp"
#include "tools/runs/further_integral.hpp"
#include "tools/show/nve_view.hpp"
#include "tools/text/proofs/proof_details.hpp"
#include "tools/text/proofs/proof_report.hpp"
#include "tools/text/proofs/proof_table.hpp"
#include "tools/text/runs/run_report.hpp"
#include "tools/typeset/html.hpp"
#include "tools/typeset/mathml.hpp"

namespace casimir::tools {
namespace {

std::string labelled(const std::string& label, const std::string& words) {
  return fmt::format("<div><span class=\"label\">{}</span> {}</div>", label,
                     html::text(words, 4000));
}

std::string kind_words(std::string kind) {
  for (char& c : kind)
    if (c == '_') c = ' ';
  return html::text(kind);
}

std::string details(const Proof& proof) {
  std::string text;
  if (!proof.evidence.empty()) text += "<div>" + html::text(proof.evidence, 4000) + "</div>";
  for (const ProofDetail& own : details_of(proof)) text += labelled(own.label, own.text);
  for (const std::string& line : judgement_lines(proof))
    text += "<div>" + html::text(line) + "</div>";
  return text.empty() ? "" : "<div class=\"evidence\">" + text + "</div>";
}

std::string claim(const Proof& proof) {
  std::string on;
  for (const std::string& level : proof.on) on += (on.empty() ? "" : " = ") + html::text(level);
  if (!on.empty()) on = " <span class=\"on\">on " + on + " = 0</span>";
  if (!proof.where.empty())
    on += " <span class=\"on\">" + html::text(where_text(proof.where), 4000) + "</span>";
  return fmt::format(
      "<li class=\"claim {}\"><span class=\"verdict\">{}</span> <span class=\"kind\">{}</span> "
      "<span class=\"name\">{}{}</span> <span class=\"time\">{}</span>{}</li>\n",
      to_string(proof.verdict), verdict_mark(proof.verdict), kind_words(to_string(proof.kind)),
      html::text(proof.name), on, duration_text(proof.seconds), details(proof));
}

std::string list(const std::string& heading, const std::string& claims) {
  return claims.empty() ? ""
                        : "<h3>" + heading + "</h3>\n<ul class=\"claims\">\n" + claims + "</ul>\n";
}

/// Whether a further integral is excluded, with the equations that show it.
std::string further_part(const Model& model, const obstruction::Obstruction& answer) {
  std::string text =
      "<h3>A further integral</h3>\n" + html::paragraph(further_integral_text(answer));
  if (!answer.proved || answer.examined.empty()) return text;
  const NveView view = nve_views(model, answer).back();
  std::string equations;
  for (const Formula& f : view.formulas)
    equations += "<div class=\"left\">" + typeset::mathml(f.left.math) +
                 "</div><div class=\"right\"><math><mo>=</mo></math>" +
                 typeset::mathml(f.right.math) + "</div>\n";
  if (!equations.empty()) text += "<div class=\"equations stacked\">\n" + equations + "</div>\n";
  if (!view.nve.empty()) text += html::paragraph(view.nve);
  return text + html::paragraph("Its Galois group: " + view.outcome + ".");
}

}  // namespace

std::string verdict_mark(Verdict verdict) {
  const char* mark = verdict == Verdict::proved ? "✓" : verdict == Verdict::refuted ? "✗" : "?";
  return fmt::format("<span aria-hidden=\"true\">{}</span> {}", mark, to_string(verdict));
}

std::string claims_part(const Model& model, const Findings& findings) {
  std::string counted, facts, notes;
  for (const Proof& proof : findings.proofs) {
    std::string& place = proof.note ? notes : proof.fact && !counts(model, proof) ? facts : counted;
    place += claim(proof);
  }
  std::string text = "<section id=\"claims\">\n<h2>What is proved</h2>\n";
  const Tally tally = tally_of(model, findings.proofs);
  if (tally.all() == 0)
    text += "<p>Nothing is claimed.</p>\n";
  else
    text += fmt::format(
        "<p>Every claim is decided exactly, in the variables and in symbolic parameters: no "
        "floating "
        "point, no sampling. {}; {}.</p>\n",
        tally.text(), duration_text(findings.proof_seconds));
  text += list("Claims", counted) + list("Facts about the system", facts) +
          list("Beside the claims", notes);
  if (findings.obstruction) text += further_part(model, *findings.obstruction);
  return text + "</section>\n";
}

}  // namespace casimir::tools
