#include "tools/report/page.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "symbolic/error.hpp"
#include "tools/report/style.hpp"
#include "tools/text/proofs/proof_table.hpp"
#include "tools/typeset/html.hpp"

namespace casimir::tools {
namespace {

/// For a shell: as it is where that is safe, else in single quotes.
std::string shell_word(const std::string& word) {
  const std::string plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

struct Entry {
  const char *id, *words;
};
constexpr Entry kContents[] = {{"system", "System"},
                               {"claims", "Claims"},
                               {"code", "Generated code"},
                               {"motion", "Motion"},
                               {"drift", "Drift"},
                               {"section", "Section"},
                               {"work-precision", "Error against time"},
                               {"runs", "Runs"},
                               {"machine", "Machine"},
                               {"reproduce", "Reproduce"}};

std::string contents(const std::string& body, const std::string& index) {
  std::string text = "<nav aria-label=\"Contents\"><ul>\n";
  if (!index.empty()) text += "<li><a href=\"" + html::text(index) + "\">All cases</a></li>\n";
  for (const Entry& entry : kContents) {
    if (body.find(fmt::format("<section id=\"{}\"", entry.id)) != std::string::npos)
      text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", entry.id, entry.words);
  }
  return text + "</ul></nav>\n";
}

std::string head_part(const Model& model, const Findings& findings) {
  std::string text = "<header>\n<h1>" + html::text(model.title) + "</h1>\n<p class=\"soft\">";
  text += html::text(
      fmt::format("{}, {}, {} variables", model.name, model.phase_space, model.variables.size()));
  if (!model.source.empty()) text += "; " + html::text(model.source);
  text += "</p>\n<p><span class=\"badge " + to_string(findings.verdict) + "\">" +
          verdict_mark(findings.verdict) + "</span> " +
          html::text(tally_of(model, findings.proofs).text()) +
          (model.integrable ? "; the case claims Liouville integrability" : "") + "</p>\n";
  return text + "</header>\n";
}

std::string notes_part(const Findings& findings, const Pictures& pictures) {
  std::string lines;
  const auto add = [&](const std::string& note) { lines += "<li>" + html::text(note) + "</li>\n"; };
  for (const std::string& note : findings.problems) add(note);
  if (!pictures.problem.empty()) add(pictures.problem);
  for (const std::string& note : findings.notes) add(note);
  if (!pictures.section_note.empty()) add(pictures.section_note);
  return lines.empty() ? "" : "<div class=\"notes\"><ul>\n" + lines + "</ul></div>\n";
}

/// An expression that cannot be written down must not cost the rest of the page.
std::string typeset_system(const Model& model) {
  try {
    return system_part(model);
  } catch (const ModelError& problem) {
    return "<section id=\"system\">\n<h2>The system</h2>\n" +
           html::paragraph(std::string("It cannot be typeset: ") + problem.what()) + "</section>\n";
  }
}

}  // namespace

std::string page_head(const std::string& title, const std::string& description) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"casimir {}\">\n"
      "<meta name=\"description\" content=\"{}\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
      CASIMIR_VERSION, html::text(description), html::text(title), page_style());
}

std::string page_end() {
  const std::time_t now = std::time(nullptr);
  return fmt::format(
      "<footer><p>Written by casimir {} on {:%Y-%m-%d}.</p></footer>\n</body>\n</html>\n",
      CASIMIR_VERSION, fmt::gmtime(now));
}

std::string reproduce_part(const Model& model, const Findings& findings, const PageSource& source) {
  std::string options;
  for (const std::string& option : source.options) options += " " + shell_word(option);
  const std::string what = shell_word(source.argument) + options;
  std::string commands;
  const auto add = [&](const std::string& command) { commands += "casimir " + command + "\n"; };
  add("show " + what);
  add("verify " + what);
  if (findings.scene) {
    const std::string name = shell_word(model.name);
    add("generate " + what + " --with rhs,invariants,gradients,jacobian -o " + name + ".hpp");
    add("integrate " + what + " --plot " + name + "-motion.svg");
    add("conserve " + what + " --plot " + name + "-drift.svg");
    if (model.section) add("section " + what + " --output " + name + "-section.svg");
    if (findings.contest) add("bench " + what + " --plot " + name + "-bench.svg");
  }
  add("report " + what);
  std::string text = "<section id=\"reproduce\">\n<h2>How to have this again</h2>\n<pre>" +
                     html::lines(commands) + "</pre>\n";
  if (!source.case_text.empty()) {
    text += "<details><summary>The case file</summary>\n<pre>" + html::lines(source.case_text) +
            "</pre>\n</details>\n";
  }
  return text + "</section>\n";
}

std::string report_page(const Model& model, const Findings& findings, const Pictures& pictures,
                        const PageSource& source) {
  const std::string body =
      notes_part(findings, pictures) + typeset_system(model) + claims_part(model, findings) +
      code_part(findings) + motion_part(findings, pictures) + drift_part(findings, pictures) +
      section_part(model, pictures) + work_precision_part(findings, pictures) +
      runs_part(findings) + machine_part(findings) + reproduce_part(model, findings, source);
  return page_head(model.title, "Report on " + model.name + ": equations, proofs, code and runs") +
         head_part(model, findings) + contents(body, source.index) + "<main>\n" + body +
         "</main>\n" + page_end();
}

}  // namespace casimir::tools
