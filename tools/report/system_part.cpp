// The system of a report, typeset.
#include <fmt/format.h>

#include <algorithm>

#include "codegen/dag/expression_dag.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "tools/report/page.hpp"
#include "tools/show/show.hpp"
#include "tools/typeset/html.hpp"
#include "tools/typeset/mathml.hpp"

namespace casimir::tools {
namespace {

using typeset::mathml;

/// More equations than this are folded away.
constexpr std::size_t kMany = 14;

std::string heading(const std::string& words) { return "<h3>" + html::text(words) + "</h3>\n"; }

const std::string kEqual = "<math><mo form=\"infix\">=</mo></math> ";

/// The common zero level of functions; empty for none.
std::string level(const std::vector<Written>& on) {
  std::string text;
  for (const Written& f : on) text += mathml(f.math) + kEqual;
  if (text.empty()) return text;
  return " <span class=\"on\">on " + text + "<math><mn>0</mn></math></span>";
}

/// Formulas with their equal signs below each other; where a left side is long, below it.
std::string equations(const std::vector<Formula>& formulas) {
  constexpr std::size_t kLongLeft = 30;  // letters of its text
  const bool stacked = std::ranges::any_of(
      formulas, [](const Formula& f) { return f.left.text.size() > kLongLeft; });
  std::string text = fmt::format("<div class=\"equations{}\">\n", stacked ? " stacked" : "");
  for (const Formula& f : formulas) {
    text += "<div class=\"left\">" + mathml(f.left.math) + "</div><div class=\"right\">" + kEqual +
            mathml(f.right.math);
    text += level(f.on) + "</div>\n";
  }
  return text + "</div>\n";
}

std::string folded(const std::string& title, const std::vector<Formula>& formulas) {
  if (formulas.empty()) return "";
  if (formulas.size() <= kMany) return heading(title) + equations(formulas);
  return "<details><summary>" + html::text(title) + fmt::format(" ({})", formulas.size()) +
         "</summary>\n" + equations(formulas) + "</details>\n";
}

void append_formulas(std::vector<Formula>& list, const std::vector<Formula>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

std::string bracket(const Model& model, const SystemView& view) {
  std::vector<Formula> lines;
  for (const VectorEntries& v : view.vectors) {
    lines.push_back({v.shown, {"", typeset::in_brackets(typeset::list(maths(v.entries)))}});
  }
  append_formulas(lines, view.vector_brackets);
  constexpr std::size_t kFew = 3;
  if (!view.vector_brackets.empty() && view.zero_brackets.size() <= kFew)
    append_formulas(lines, view.zero_brackets);
  const bool as_matrix = view.variables.size() <= kLargestMatrix;
  if (!as_matrix && view.vector_brackets.empty()) append_formulas(lines, view.brackets);
  std::string text = folded("Poisson bracket", lines);
  if (lines.empty()) text += heading("Poisson bracket");
  if (as_matrix && !view.structure_matrix.empty()) {
    text += "<div class=\"scroll display\"><math><mi>J</mi><mo>=</mo></math>" +
            mathml(maths(view.structure_matrix)) + "</div>\n";
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

/// The body of a function that a scene gives, behind its arguments: the same text in every run.
std::string function_text(const Model& model, const GiNaC::lst& function) {
  std::vector<GiNaC::symbol> symbols;
  for (std::size_t i = 0; i + 1 < function.nops(); ++i)
    symbols.push_back(GiNaC::ex_to<GiNaC::symbol>(function.op(i)));
  symbols.insert(symbols.end(), model.parameters.begin(), model.parameters.end());
  codegen::Dag dag(symbols, function.nops() - 1);
  return dag.text(dag.convert(function.op(function.nops() - 1)));
}

std::string scene_values(const Model& model, const Scene& scene) {
  std::string list;
  const auto add = [&](const std::string& name, const std::string& value) {
    list += (list.empty() ? "" : ", ") + html::text(name) + " = " + html::text(value, 60);
  };
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const GiNaC::symbol& parameter = model.parameters[i];
    const GiNaC::ex& given = scene.parameters[i];
    if (GiNaC::is_a<GiNaC::lst>(given))
      add(parameter.get_name(), function_text(model, GiNaC::ex_to<GiNaC::lst>(given)));
    else if (function_name(parameter.get_name()))
      add(parameter.get_name(), "not given");
    else
      add(parameter.get_name(), expression_text(given));
  }
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    add(model.variables[i].get_name(), expression_text(scene.initial[i]));
  if (!scene.duration) return list;
  return list + "; duration " + html::text(expression_text(*scene.duration), 60);
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

/// The rate of L is the commutator [L, A].
const std::string kLaxEquation =
    "<math><mover accent=\"true\"><mi>L</mi><mo stretchy=\"false\">˙</mo></mover>"
    "<mo form=\"infix\">=</mo><mo stretchy=\"false\">[</mo><mi>L</mi><mo separator=\"true\">,</mo>"
    "<mi>A</mi><mo stretchy=\"false\">]</mo></math>";

std::string lax_pairs(const SystemView& view) {
  std::string text;
  for (const LaxView& pair : view.lax_pairs) {
    text += heading("Lax pair");
    text += "<div class=\"scroll display\">" + kLaxEquation +
            (pair.spectral ? " for every " + mathml(pair.spectral->math) : "") + level(pair.on) +
            "</div>\n";
    for (const auto& [name, matrix] : {std::pair{"L", &pair.l}, std::pair{"A", &pair.a}}) {
      text +=
          fmt::format("<div class=\"scroll display\"><math><mi>{}</mi><mo>=</mo></math>{}</div>\n",
                      name, mathml(maths(*matrix)));
    }
  }
  return text;
}

}  // namespace

std::string system_part(const Model& model) {
  Notation notation(model);
  const SystemView view = view_of(model, notation);
  std::string text = "<section id=\"system\">\n<h2>The system</h2>\n";
  if (model.poisson) text += bracket(model, view);
  if (view.hamiltonian)
    text += heading("Hamiltonian") + equations({{{"H", typeset::letter("H")}, *view.hamiltonian}});
  std::vector<Formula> motion = view.vector_equations;
  append_formulas(motion, view.gradients);
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
