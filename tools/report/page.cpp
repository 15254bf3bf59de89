#include "tools/report/page.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "symbolic/error.hpp"
#include "tools/analysis/error.hpp"
#include "tools/report/style.hpp"
#include "tools/text/proofs/proof_report.hpp"
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

struct ContentsEntry {
  const char *id, *words;
};
constexpr ContentsEntry kContents[] = {{"system", "System"},
                                       {"claims", "Claims"},
                                       {"code", "Generated code"},
                                       {"motion", "Motion"},
                                       {"drift", "Drift"},
                                       {"section", "Section"},
                                       {"work-precision", "Error against time"},
                                       {"runs", "Runs"},
                                       {"machine", "Machine"},
                                       {"reproduce", "Reproduce"}};

std::string contents(const std::string& body, const PageSource& source) {
  std::string text = "<nav aria-label=\"Contents\"><ul>\n";
  const auto link = [&](const std::string& page, const char* words, const char* relation) {
    if (page.empty()) return;
    text += fmt::format("<li><a rel=\"{}\" href=\"{}\">{}</a></li>\n", relation, html::text(page),
                        words);
  };
  link(source.index, "All cases", "up");
  link(source.before, "← before", "prev");
  link(source.after, "next →", "next");
  for (const ContentsEntry& entry : kContents) {
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
  const std::string where = where_text(conditions_of(model, findings.proofs));
  text += "</p>\n<p>";
  const Tally tally = tally_of(model, findings.proofs);
  if (tally.all() > 0)
    text += "<span class=\"badge " + to_string(findings.verdict) + "\">" +
            verdict_mark(findings.verdict) + "</span>" + html::text(where, 4000) +
            (where.empty() ? " " : "; ");
  text += html::text(tally.text()) +
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

/// The case and the options, for a shell.
std::string typed(const PageSource& source) {
  std::string words = shell_word(source.argument);
  for (const std::string& option : source.options) words += " " + shell_word(option);
  return words;
}

/// The data of what the script integrates; a comment says why there are none.
std::string typeset_live(const Model& model, const Findings& findings, const Pictures& pictures,
                         const PageSource& source) {
  if (!findings.scene || !findings.motion) return "";
  const auto none = [](const std::exception& problem) {
    return html::paragraph(std::string("The page does not integrate by itself: ") + problem.what());
  };
  try {
    const LiveSystem live = live_system(model, *findings.scene, pictures.drawn_section);
    return live_part(live, *findings.motion, findings.scene->name,
                     "casimir integrate " + printable(typed(source), 4000));
  } catch (const ModelError& problem) {
    return none(problem);
  } catch (const RequestError& problem) {
    return none(problem);
  }
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

std::string page_end(const std::string& script) {
  const std::time_t now = std::time(nullptr);
  return fmt::format(
      "<footer><p>Written by casimir {} on {:%Y-%m-%d}.</p></footer>\n{}</body>\n</html>\n",
      CASIMIR_VERSION, fmt::gmtime(now), script);
}

std::string reproduce_part(const Model& model, const Findings& findings, const PageSource& source) {
  const std::string what = typed(source);
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
  // The script comes before the pictures: the motion that it draws does not wait for them.
  const std::string body =
      notes_part(findings, pictures) + typeset_system(model) + claims_part(model, findings) +
      typeset_live(model, findings, pictures, source) + page_script() + code_part(findings) +
      motion_part(findings, pictures) + theorems_part(model, findings) +
      drift_part(findings, pictures) + section_part(model, pictures) +
      work_precision_part(findings, pictures) + runs_part(findings) + machine_part(findings) +
      reproduce_part(model, findings, source);
  return page_head(model.title, "Report on " + model.name + ": equations, proofs, code and runs") +
         head_part(model, findings) + contents(body, source) + "<main>\n" + body + "</main>\n" +
         page_end("");
}

std::string page_without_report(const std::string& title, const std::string& problem,
                                const PageSource& source) {
  return page_head(title, "A case without a report") + "<header>\n<h1>" + html::text(title) +
         "</h1>\n</header>\n" + contents("", source) + "<main>\n" +
         html::paragraph("There is no report: " + problem) + "</main>\n" + page_end("");
}

}  // namespace casimir::tools
