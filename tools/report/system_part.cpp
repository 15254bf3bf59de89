// The system of a report, typeset.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "tools/report/html.hpp"
#include "tools/report/mathml.hpp"
#include "tools/report/page.hpp"
#include "tools/show/show.hpp"

namespace casimir::tools {
namespace {

/// More equations than this are folded away.
constexpr std::size_t kMany = 14;

std::string heading(const std::string& words) { return "<h3>" + html::text(words) + "</h3>\n"; }

/// Formulas with their equal signs below each other; where a left side is long, below it.
std::string equations(const std::vector<Formula>& formulas) {
  constexpr std::size_t kLongLeft = 60;  // bytes of LaTeX
  const bool stacked =
      std::ranges::any_of(formulas, [](const Formula& f) { return f.left.size() > kLongLeft; });
  std::string text = fmt::format("<div class=\"equations{}\">\n", stacked ? " stacked" : "");
  for (const Formula& f : formulas) {
    std::string on;
    for (const std::string& level : f.on) on += (on.empty() ? "" : " = ") + level;
    text += "<div class=\"left\">" + mathml(f.left) +
            "</div><div class=\"right\"><math><mo form=\"infix\">=</mo></math> " + mathml(f.right);
    if (!on.empty()) text += " <span class=\"on\">on " + mathml(on + " = 0") + "</span>";
    text += "</div>\n";
  }
  return text + "</div>\n";
}

std::string folded(const std::string& title, const std::vector<Formula>& formulas) {
  if (formulas.empty()) return "";
  if (formulas.size() <= kMany) return heading(title) + equations(formulas);
  return "<details><summary>" + html::text(title) + fmt::format(" ({})", formulas.size()) +
         "</summary>\n" + equations(formulas) + "</details>\n";
}

void append(std::vector<Formula>& list, const std::vector<Formula>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

std::string bracket(const Model& model, const SystemView& view) {
  std::vector<Formula> lines;
  for (const VectorEntries& v : view.vectors) {
    std::string entries;
    for (const std::string& entry : v.entries) entries += (entries.empty() ? "" : ", ") + entry;
    lines.push_back({v.shown, "\\left(" + entries + "\\right)"});
  }
  append(lines, view.vector_brackets);
  constexpr std::size_t kFew = 3;
  if (!view.vector_brackets.empty() && view.zero_brackets.size() <= kFew)
    append(lines, view.zero_brackets);
  const bool as_matrix = view.variables.size() <= kLargestMatrix;
  if (!as_matrix && view.vector_brackets.empty()) append(lines, view.brackets);
  std::string text = folded("Poisson bracket", lines);
  if (lines.empty()) text += heading("Poisson bracket");
  if (as_matrix && !view.structure_matrix.empty()) {
    text += "<div class=\"scroll display\"><math><mi>J</mi><mo>=</mo></math>" +
            mathml_matrix(view.structure_matrix) + "</div>\n";
  }
  if (const auto rank = rank_of(model))
    text += "<p class=\"evidence\">" + html::text(rank->name + ": " + rank->evidence) + "</p>\n";
  return text;
}

std::string conditions(const Model& model) {
  std::string list;
  for (const Assumption& a : model.assumptions)
    list += (list.empty() ? "" : ", ") + ("<code>" + html::text(a.text) + "</code>");
  return list.empty() ? "" : "<p>Assumed: " + list + ".</p>\n";
}

std::string scene_values(const Model& model, const Scene& scene) {
  const auto value = [](const GiNaC::ex& e) { return html::text(expression_text(e), 60); };
  std::string list;
  const auto add = [&](const GiNaC::symbol& symbol, const GiNaC::ex& e) {
    list += (list.empty() ? "" : ", ") + html::text(symbol.get_name()) + " = " + value(e);
  };
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    add(model.parameters[i], scene.parameters[i]);
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    add(model.variables[i], scene.initial[i]);
  return scene.duration ? list + "; duration " + value(*scene.duration) : list;
}

std::string scenes(const Model& model) {
  if (model.scenes.empty()) return "";
  std::string text = "<details><summary>Scenes</summary>\n<dl>\n";
  for (const Scene& scene : model.scenes) {
    text += "<dt>" + html::text(scene.name) +
            (scene.extreme ? " <small>" + html::text(to_string(*scene.extreme)) + "</small>" : "") +
            "</dt><dd>" +
            (scene.unusable.empty() ? scene_values(model, scene) : html::text(scene.unusable)) +
            "</dd>\n";
  }
  return text + "</dl>\n</details>\n";
}

std::string lax_pairs(const SystemView& view) {
  std::string text;
  for (const LaxView& pair : view.lax_pairs) {
    text += heading("Lax pair");
    text += "<div class=\"scroll display\">" + mathml("\\dot{L} = [L, A]") +
            (pair.spectral.empty() ? "" : " for every " + mathml(pair.spectral)) + "</div>\n";
    for (const auto& [name, matrix] : {std::pair{"L", &pair.l}, std::pair{"A", &pair.a}}) {
      text +=
          fmt::format("<div class=\"scroll display\"><math><mi>{}</mi><mo>=</mo></math>{}</div>\n",
                      name, mathml_matrix(*matrix));
    }
  }
  return text;
}

}  // namespace

std::string system_part(const Model& model) {
  Notation notation(model);
  const SystemView view = view_of(model, notation, Markup::latex);
  std::string text = "<section id=\"system\">\n<h2>The system</h2>\n";
  if (model.poisson) text += bracket(model, view);
  if (!view.hamiltonian.empty())
    text += heading("Hamiltonian") + equations({{"H", view.hamiltonian}});
  std::vector<Formula> motion = view.vector_equations;
  append(motion, view.gradients);
  text += folded("Equations of motion", motion);
  text += folded(motion.empty() ? "Equations of motion" : "The same in components", view.equations);
  text += conditions(model);
  for (const FormulaGroup& group : view.claims) {
    std::string title = group.title;
    if (!title.empty() && title[0] >= 'a' && title[0] <= 'z')
      title[0] = static_cast<char>(title[0] - 'a' + 'A');
    text += folded(title, group.formulas);
  }
  return text + lax_pairs(view) + scenes(model) + "</section>\n";
}

}  // namespace casimir::tools
