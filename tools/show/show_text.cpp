// The text of casimir show.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/show/show.hpp"
#include "tools/text/text_layout.hpp"

namespace casimir::tools {
namespace {

std::vector<std::string> names_in_order(const std::vector<GiNaC::symbol>& symbols) {
  std::vector<std::string> result;
  for (const GiNaC::symbol& s : symbols) result.push_back(s.get_name());
  return result;
}

void print_head(const Model& model) {
  const auto line = [](const char* label, const std::string& value) {
    if (!value.empty()) fmt::print("{:<13}{}\n", label, value);
  };
  fmt::print("{}\n", printable(model.title.empty() ? model.name : model.title, 200));
  line("source", printable(model.source, 200));
  line("phase space",
       fmt::format("{} in {}", model.phase_space, fmt::join(names_in_order(model.variables), " ")));
  line("parameters", fmt::format("{}", fmt::join(names_in_order(model.parameters), " ")));
  std::vector<std::string> assumptions;
  for (const Assumption& a : model.assumptions) assumptions.push_back(a.text);
  line("assuming", fmt::format("{}", fmt::join(assumptions, ", ")));
}

void print_formulas(const std::string& title, const std::vector<Formula>& formulas) {
  if (formulas.empty()) return;
  fmt::print("\n{}\n", title);
  std::size_t width = 0;
  for (const Formula& f : formulas) width = std::max(width, display_width(f.left.text));
  constexpr std::size_t kLongName = 24;
  for (const Formula& f : formulas) {
    fmt::print("  {} = {}{}\n", padded(f.left.text, width > kLongName ? 0 : width), f.right.text,
               f.on.empty() ? "" : fmt::format("  on {} = 0", fmt::join(texts(f.on), " = ")));
  }
}

void print_wrapped(const std::string& text) {
  constexpr std::size_t kIndent = 2;
  bool first = true;
  for (const std::string& line : wrapped(text, output_width() - kIndent)) {
    fmt::print("{}{}\n", first ? "" : "  ", line);
    first = false;
  }
}

/// The matrix with the variables above and beside it; false if it is too wide for that.
bool print_matrix(const SystemView& view) {
  const std::size_t n = view.variables.size();
  if (n > kLargestMatrix) return false;
  std::vector<std::size_t> widths(n);
  std::size_t label = 0;
  std::size_t total = 2;
  for (std::size_t j = 0; j < n; ++j) {
    widths[j] = view.variables[j].text.size();
    for (const auto& row : view.structure_matrix)
      widths[j] = std::max(widths[j], row[j].text.size());
    label = std::max(label, view.variables[j].text.size());
    total += widths[j] + 2;
  }
  if (total + label > output_width()) return false;
  fmt::print("\nbracket matrix {{row, column}}\n  {}", padded("", label));
  for (std::size_t j = 0; j < n; ++j)
    fmt::print("  {}", padded(view.variables[j].text, widths[j], true));
  for (std::size_t i = 0; i < n; ++i) {
    fmt::print("\n  {}", padded(view.variables[i].text, label));
    for (std::size_t j = 0; j < n; ++j)
      fmt::print("  {}", padded(view.structure_matrix[i][j].text, widths[j], true));
  }
  fmt::print("\n");
  return true;
}

void print_vector_brackets(const SystemView& view) {
  if (view.vector_brackets.empty()) return;
  // {g_i, g_j} = 0 is said as people say it, but not every pair of a dozen blocks.
  constexpr std::size_t kFew = 3;
  std::vector<Formula> shown = view.vector_brackets;
  const bool few = view.zero_brackets.size() <= kFew;
  if (few) shown.insert(shown.end(), view.zero_brackets.begin(), view.zero_brackets.end());
  print_formulas(few ? "brackets" : "brackets (the others are zero)", shown);
}

void print_bracket(const Model& model, const SystemView& view) {
  std::vector<Formula> vectors;
  for (const VectorEntries& v : view.vectors)
    vectors.push_back({v.shown, {fmt::format("({})", fmt::join(texts(v.entries), ", ")), {}}});
  print_formulas("vectors", vectors);
  print_vector_brackets(view);
  const bool as_matrix = print_matrix(view);
  if (!as_matrix && view.vector_brackets.empty())
    print_formulas("brackets (the others are zero or follow by skew symmetry)", view.brackets);
  if (const auto rank = rank_of(model)) {
    fmt::print("\n");
    print_wrapped(rank->name + ": " + rank->evidence);
  }
}

void print_lax_pairs(const std::vector<LaxView>& pairs) {
  const auto print = [](const char* name, const WrittenMatrix& m) {
    for (std::size_t i = 0; i < m.size(); ++i)
      fmt::print("  {} {}[{}]{}\n", i == 0 ? fmt::format("{} = ", name) : "    ",
                 i == 0 ? "[" : " ", fmt::join(texts(m[i]), ", "), i + 1 == m.size() ? "]" : ",");
  };
  for (const LaxView& pair : pairs) {
    fmt::print(
        "\nLax pair, dL/dt = [L, A]{}{}\n",
        pair.spectral ? " for every " + pair.spectral->text : "",
        pair.on.empty() ? "" : fmt::format(" where {} = 0", fmt::join(texts(pair.on), " = ")));
    print("L", pair.l);
    print("A", pair.a);
  }
}

void print_system(const Model& model, const SystemView& view) {
  print_head(model);
  if (model.poisson) print_bracket(model, view);
  if (view.hamiltonian) print_formulas("Hamiltonian", {{{"H", {}}, *view.hamiltonian}});
  print_formulas("map", view.map);
  print_formulas("equations of motion", view.vector_equations);
  print_formulas("with the gradients", view.gradients);
  print_formulas(view.vector_equations.empty() ? "equations of motion" : "in components",
                 view.equations);
  for (const FormulaGroup& group : view.claims)
    print_formulas(printable(group.title, 200), group.formulas);
  print_lax_pairs(view.lax_pairs);
  std::vector<std::string> scenes;
  for (const Scene& scene : model.scenes) scenes.push_back(scene.name);
  if (!scenes.empty()) fmt::print("\nscenes       {}\n", fmt::join(scenes, "; "));
}

}  // namespace

void show_text(const Model& model) {
  Notation notation(model);
  print_system(model, view_of(model, notation));
}

void show_text(const MapModel& map) {
  Notation notation(map.base);
  print_system(map.base, view_of(map, notation));
}

}  // namespace casimir::tools
