#include "tests/adversary/case.hpp"

#include <array>

namespace casimir::adversary {
namespace {

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

template <typename List, typename Text>
std::string listed(const List& list, const Text& text) {
  std::string result;
  for (const auto& item : list) result += (result.empty() ? "" : ", ") + quoted(text(item));
  return "[" + result + "]";
}

std::string of_expressions(const std::vector<Expr>& list) {
  return listed(list, [](const Expr& e) { return e.text(); });
}

std::string of_assumptions(const std::vector<Assumption>& list) {
  return listed(list, [](const Assumption& a) { return a.text(); });
}

std::string of_names(const std::vector<std::string>& list) {
  return listed(list, [](const std::string& name) { return name; });
}

/// The sign of the permutation i, j, k of 0, 1, 2; 0 if it is none.
int levi_civita(std::size_t i, std::size_t j, std::size_t k) {
  return static_cast<int>((j + 3 - i) % 3 == 1 && (k + 3 - j) % 3 == 1) -
         static_cast<int>((i + 3 - j) % 3 == 1 && (j + 3 - k) % 3 == 1);
}

/// -eps_ijk of the vector whose components start at `first`.
Expr rotated(const std::vector<std::string>& names, std::size_t first, std::size_t i,
             std::size_t j) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (const int sign = levi_civita(i, j, k); sign != 0)
      return Expr(-sign) * Expr(names[first + k]);
  }
  return 0;
}

std::string entries_text(const System& system, const std::string& table) {
  std::string text = "[" + table + "]\n";
  for (const auto& [place, entry] : system.entries)
    text += quoted(system.variables[place.first] + "," + system.variables[place.second]) + " = " +
            quoted(entry.text()) + "\n";
  return text;
}

std::string phase_space_text(const System& system) {
  std::string text = "[phase_space]\nvariables = " + of_names(system.variables) + "\n";
  if (!system.time.empty()) text += "time = " + quoted(system.time) + "\n";
  if (!system.domain.empty()) text += "domain = " + of_assumptions(system.domain) + "\n";
  switch (system.bracket) {
    case Bracket::canonical:
      return text + "canonical = true\n";
    case Bracket::so3:
      return text + "algebra = \"so(3)\"\n";
    case Bracket::e3:
      return text + "algebra = \"e(3)\"\n";
    case Bracket::structure_constants:
      return text + entries_text(system, "phase_space.structure_constants");
    case Bracket::brackets:
      return text + entries_text(system, "phase_space.brackets");
    case Bracket::none:
      break;
  }
  text += "[equations]\n";
  for (std::size_t i = 0; i < system.variables.size(); ++i)
    text += system.variables[i] + " = " + quoted(system.equations[i].text()) + "\n";
  return text;
}

std::string parameters_text(const std::vector<Parameter>& parameters) {
  if (parameters.empty()) return {};
  std::string text = "[parameters]\n";
  for (const Parameter& p : parameters) {
    text += p.name + " = {";
    if (!p.assume.empty()) text += " assume = " + of_assumptions(p.assume) + " ";
    text += "}\n";
  }
  return text;
}

std::string table(const std::string& name, const std::vector<Named>& entries) {
  if (entries.empty()) return {};
  std::string text = "[" + name + "]\n";
  for (const Named& entry : entries) text += entry.name + " = " + quoted(entry.value.text()) + "\n";
  return text;
}

std::string levels_text(const std::string& kind, const std::vector<OnLevel>& claims) {
  std::string text;
  for (const OnLevel& claim : claims) {
    text += "[[" + kind + "]]\nname = " + quoted(claim.name) +
            "\nexpression = " + quoted(claim.expression.text()) + "\n";
    if (!claim.on.empty()) text += "on = " + of_expressions(claim.on) + "\n";
  }
  return text;
}

std::string matrix_text(const Matrix& matrix) {
  std::string text;
  for (const auto& row : matrix) text += (text.empty() ? "" : ", ") + of_expressions(row);
  return "[" + text + "]";
}

std::string map_text(const Map& map) {
  const System& target = map.target;
  std::string text =
      "[[map]]\nname = \"map\"\nsign = " + quoted(map.sign > 0 ? "+" : "-") + "\nexpressions = { ";
  for (std::size_t i = 0; i < map.expressions.size(); ++i)
    text += (i > 0 ? ", " : "") + target.variables[i] + " = " + quoted(map.expressions[i].text());
  text += " }\nto = { variables = " + of_names(target.variables);
  if (target.bracket == Bracket::canonical) return text + ", canonical = true }\n";
  if (target.bracket == Bracket::so3) return text + ", algebra = \"so(3)\" }\n";
  text += ", brackets = { ";
  bool first = true;
  for (const auto& [place, entry] : target.entries) {
    text += std::string(first ? "" : ", ") +
            quoted(target.variables[place.first] + "," + target.variables[place.second]) + " = " +
            quoted(entry.text());
    first = false;
  }
  return text + " } }\n";
}

}  // namespace

Expr System::bracket_of(std::size_t i, std::size_t j) const {
  if (i == j) return 0;
  const std::size_t half = variables.size() / 2;
  switch (bracket) {
    case Bracket::canonical:
      return j == i + half ? 1 : i == j + half ? -1 : 0;
    case Bracket::so3:
      return rotated(variables, 0, i, j);
    case Bracket::e3:
      if (i >= 3 && j >= 3) return 0;
      return rotated(variables, i >= 3 || j >= 3 ? 3 : 0, i % 3, j % 3);
    default:
      break;
  }
  const auto it = entries.find({std::min(i, j), std::max(i, j)});
  if (it == entries.end()) return 0;
  return i < j ? it->second : -it->second;
}

std::vector<std::string> System::symbols() const {
  std::vector<std::string> result = variables;
  for (const Parameter& p : parameters) result.push_back(p.name);
  if (!time.empty()) result.push_back(time);
  return result;
}

std::vector<Assumption> System::assumptions() const {
  std::vector<Assumption> result = domain;
  for (const Parameter& p : parameters)
    result.insert(result.end(), p.assume.begin(), p.assume.end());
  return result;
}

std::string to_string(Kind kind) {
  static const std::array<const char*, 18> names{
      "integral",  "casimir", "jacobi",        "identity",   "conditional",  "invariant_relation",
      "lax",       "measure", "map",           "involution", "independence", "rank",
      "liouville", "search",  "search --free", "exponents",  "darboux",      "certificate"};
  return names[static_cast<std::size_t>(kind)];
}

std::string to_string(Truth truth) {
  return truth == Truth::yes ? "true" : truth == Truth::no ? "false" : "about nothing";
}

std::string Case::text() const {
  std::string text = "title = \"t\"\n";
  if (integrable) text += "integrable = true\n";
  if (system.bracket != Bracket::none)
    text += "hamiltonian = " + quoted(system.hamiltonian.text()) + "\n";
  text += phase_space_text(system) + parameters_text(system.parameters) +
          table("definitions", system.definitions) + table("casimirs", casimirs) +
          table("integrals", integrals) + levels_text("conditional", conditionals) +
          levels_text("invariant_relation", invariant_relations);
  for (const IdentityClaim& claim : identities) {
    text += "[[identity]]\nname = \"identity\"\nleft = " + quoted(claim.left.text()) +
            "\nright = " + quoted(claim.right.text()) + "\n";
    if (!claim.on.empty()) text += "on = " + of_expressions(claim.on) + "\n";
  }
  for (const Lax& pair : lax) {
    text += "[[lax]]\n";
    if (!pair.spectral.empty()) text += "spectral = " + quoted(pair.spectral) + "\n";
    text += "L = " + matrix_text(pair.l) + "\nA = " + matrix_text(pair.a) + "\n";
  }
  for (const Measure& measure : measures) {
    text += "[[measure]]\ndensity = " + quoted(measure.density.text()) + "\n";
    if (measure.every_hamiltonian) text += "every_hamiltonian = true\n";
  }
  for (const Map& map : maps) text += map_text(map);
  return text;
}

}  // namespace casimir::adversary
