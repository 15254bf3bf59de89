// The LaTeX of casimir show.
#include <fmt/format.h>

#include "tools/show/show.hpp"
#include "tools/typeset/latex.hpp"

namespace casimir::tools {
namespace {

using typeset::latex;

std::string joined(const std::vector<Written>& formulas, const char* between) {
  std::string text;
  for (std::size_t i = 0; i < formulas.size(); ++i)
    text += (i > 0 ? between : "") + latex(formulas[i].math);
  return text;
}

/// A display with aligned equal signs.
void print_align(const std::vector<Formula>& formulas) {
  if (formulas.empty()) return;
  fmt::print("\\begin{{align*}}\n");
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    const Formula& f = formulas[i];
    fmt::print("{} &= {}", latex(f.left.math), latex(f.right.math));
    if (!f.on.empty()) fmt::print(" \\quad \\text{{on }} {} = 0", joined(f.on, " = "));
    fmt::print("{}\n", i + 1 < formulas.size() ? " \\\\" : "");
  }
  fmt::print("\\end{{align*}}\n");
}

std::string pmatrix(const WrittenMatrix& m) {
  std::string text = "\\begin{pmatrix}\n";
  for (std::size_t i = 0; i < m.size(); ++i)
    text += fmt::format("{}{}\n", joined(m[i], " & "), i + 1 < m.size() ? " \\\\" : "");
  return text + "\\end{pmatrix}";
}

void append(std::vector<Formula>& list, const std::vector<Formula>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

void print_latex_bracket(const Model& model, const SystemView& view) {
  std::vector<Formula> lines;
  for (const VectorEntries& v : view.vectors)
    lines.push_back({v.shown, {"", {typeset::Kind::tuple, {}, {typeset::list(maths(v.entries))}}}});
  append(lines, view.vector_brackets);
  constexpr std::size_t kFew = 3;
  if (!view.vector_brackets.empty() && view.zero_brackets.size() <= kFew)
    append(lines, view.zero_brackets);
  const bool as_matrix = view.variables.size() <= kLargestMatrix;
  if (!as_matrix && view.vector_brackets.empty()) append(lines, view.brackets);
  print_align(lines);
  const auto rank = rank_of(model);
  const std::string rank_text =
      rank && rank->rank ? fmt::format("\\operatorname{{rank}} J = {}", *rank->rank) : "";
  if (as_matrix) {
    fmt::print("\\begin{{equation*}}\nJ = {}{}{}\n\\end{{equation*}}\n",
               pmatrix(view.structure_matrix), rank_text.empty() ? "" : ", \\qquad ", rank_text);
  } else if (!rank_text.empty()) {
    fmt::print("\\begin{{equation*}}\n{}\n\\end{{equation*}}\n", rank_text);
  }
}

void print_latex(const Model& model, const SystemView& view) {
  if (model.poisson) print_latex_bracket(model, view);
  std::vector<Formula> lines;
  if (view.hamiltonian) lines.push_back({{"H", typeset::letter("H")}, *view.hamiltonian});
  append(lines, view.map);
  append(lines, view.vector_equations);
  append(lines, view.gradients);
  append(lines, view.equations);
  print_align(lines);
  lines.clear();
  for (const FormulaGroup& group : view.claims) append(lines, group.formulas);
  print_align(lines);
  for (const LaxView& pair : view.lax_pairs) {
    fmt::print(
        "\\begin{{equation*}}\n\\dot{{L}} = [L, A], \\qquad L = {}, \\qquad A = {}\n"
        "\\end{{equation*}}\n",
        pmatrix(pair.l), pmatrix(pair.a));
  }
}

}  // namespace

void show_latex(const Model& model) {
  Notation notation(model);
  print_latex(model, view_of(model, notation));
}

void show_latex(const MapModel& map) {
  Notation notation(map.base);
  print_latex(map.base, view_of(map, notation));
}

}  // namespace casimir::tools
