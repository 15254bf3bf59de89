// The LaTeX of casimir show.
#include <fmt/format.h>

#include <algorithm>

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

/// The right side of an aligned equation: long sums go on below, each line with its sign.
std::string in_lines(const typeset::Math& formula) {
  constexpr double kLine = 64;
  std::string text;
  for (const typeset::Math& line : typeset::lines_of(formula, kLine)) {
    const bool plus = !text.empty() && !line.negative.front();
    text += (text.empty() ? "" : " \\\\\n&\\quad ") + std::string(plus ? "+ " : "") + latex(line);
  }
  return text;
}

/// A display with aligned equal signs.
void print_align(const std::vector<Formula>& formulas) {
  if (formulas.empty()) return;
  fmt::print("\\begin{{align*}}\n");
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    const Formula& f = formulas[i];
    fmt::print("{} &= {}", latex(f.left.math), in_lines(f.right.math));
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

/// How wide a matrix is on paper, in letters.
double width_of(const WrittenMatrix& m) {
  double all = 0;
  for (std::size_t j = 0; !m.empty() && j < m.front().size(); ++j) {
    double column = 0;
    for (const std::vector<Written>& row : m)
      column = std::max(column, typeset::width(row[j].math));
    all += column + 2;
  }
  return all;
}

/// In one line, where the matrices are no wider than a page.
void print_lax_pair(const LaxView& pair) {
  constexpr double kPage = 60;
  const bool one = width_of(pair.l) + width_of(pair.a) <= kPage;
  const char* next = one ? ", \\qquad " : ",\n\\end{equation*}\n\\begin{equation*}\n";
  std::string level;
  for (const Written& f : pair.on) level += latex(f.math) + " = ";
  if (!level.empty()) level = next + level + "0";
  fmt::print(
      "\\begin{{equation*}}\n\\dot{{L}} = [L, A]{0}L = {1}{0}A = {2}{3}\n\\end{{equation*}}\n",
      next, pmatrix(pair.l), pmatrix(pair.a), level);
}

/// A matrix of a Lax pair or of many variables is wider than a page of text.
void print_preamble(const Model& model) {
  const std::string& title = model.title.empty() ? model.name : model.title;
  fmt::print(
      "\\documentclass[a4paper]{{article}}\n\\usepackage{{amsmath}}\n"
      "\\usepackage[margin=20mm]{{geometry}}\n\\allowdisplaybreaks\n\\setcounter{{MaxMatrixCols}}{{"
      "64}}\n"
      "\\begin{{document}}\n\\section*{{{}}}\n",
      latex(typeset::prose(printable(title, 200))));
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
  for (const LaxView& pair : view.lax_pairs) print_lax_pair(pair);
}

}  // namespace

void show_latex(const Model& model, LatexUse use) {
  Notation notation(model);
  const SystemView view = view_of(model, notation);
  if (use == LatexUse::document) print_preamble(model);
  print_latex(model, view);
  if (use == LatexUse::document) fmt::print("\\end{{document}}\n");
}

void show_latex(const MapModel& map, LatexUse use) {
  Notation notation(map.base);
  const SystemView view = view_of(map, notation);
  if (use == LatexUse::document) print_preamble(map.base);
  print_latex(map.base, view);
  if (use == LatexUse::document) fmt::print("\\end{{document}}\n");
}

}  // namespace casimir::tools
