#include "tools/typeset/latex.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace casimir::tools::typeset {
namespace {

std::string joined_text(const std::vector<Math>& parts, std::size_t first, const char* between) {
  std::string text;
  for (std::size_t i = first; i < parts.size(); ++i)
    text += (i > first ? between : "") + latex(parts[i]);
  return text;
}

std::string grown(const std::string& inside) { return "\\left(" + inside + "\\right)"; }

std::string sum_text(const Math& sum) {
  std::string text;
  for (std::size_t i = 0; i < sum.parts.size(); ++i) {
    if (i == 0)
      text = sum.negative[i] ? "-" : "";
    else
      text += sum.negative[i] ? " - " : " + ";
    text += latex(sum.parts[i]);
  }
  return text;
}

std::string scripts_text(const Math& formula) {
  std::string text = latex(formula.parts[0]);
  if (!formula.parts[1].empty()) text += "_{" + latex(formula.parts[1]) + "}";
  if (!formula.parts[2].empty()) text += "^{" + latex(formula.parts[2]) + "}";
  return text;
}

/// Whether LaTeX has a command for the function.
bool has_command(std::string_view function) {
  static constexpr std::array kCommands = std::to_array<std::string_view>(
      {"arccos", "arcsin", "arctan", "arg", "cos", "cosh", "cot", "coth", "csc", "exp",
       "lg",     "ln",     "log",    "max", "min", "sec",  "sin", "sinh", "tan", "tanh"});
  return std::ranges::find(kCommands, function) != kCommands.end();
}

std::string call_text(const Math& formula) {
  std::string text =
      has_command(formula.text) ? "\\" + formula.text : "\\operatorname{" + formula.text + "}";
  if (!formula.parts[0].empty()) text += "^{" + latex(formula.parts[0]) + "}";
  return text + grown(joined_text(formula.parts, 1, ", "));
}

std::string bold_text(const Math& vector) {
  const std::string letters = latex(vector);
  if (letters.size() == 1) return "\\boldsymbol " + letters;
  if (vector.kind == Kind::letter && is_greek(vector.text)) return "\\boldsymbol" + letters;
  return "\\boldsymbol{" + letters + "}";
}

/// A name: the lines under it are no indices.
std::string word_text(const std::string& word) {
  std::string text;
  for (const char c : word) text += c == '_' ? "\\_" : std::string(1, c);
  return text;
}

/// Words as a case has them: what LaTeX would take for a command is left out or escaped.
std::string prose_text(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if (std::string("\\{}~^").find(c) != std::string::npos) continue;
    if (std::string("#$%&_").find(c) != std::string::npos) text += '\\';
    text += c;
  }
  return "\\text{" + text + "}";
}

}  // namespace

std::string latex(const Math& formula) {
  const auto part = [&](std::size_t i) { return latex(formula.parts[i]); };
  switch (formula.kind) {
    case Kind::letter:
      return is_greek(formula.text) ? "\\" + formula.text : formula.text;
    case Kind::symbol:
      return "\\" + formula.text;
    case Kind::word:
      return "\\mathrm{" + word_text(formula.text) + "}";
    case Kind::number:
      return formula.text;
    case Kind::prose:
      return prose_text(formula.text);
    case Kind::product:
      return joined_text(formula.parts, 0, " ");
    case Kind::sum:
      return sum_text(formula);
    case Kind::list:
      return joined_text(formula.parts, 0, ", ");
    case Kind::fraction:
      return "\\frac{" + part(0) + "}{" + part(1) + "}";
    case Kind::root:
      return "\\sqrt{" + part(0) + "}";
    case Kind::scripts:
      return scripts_text(formula);
    case Kind::call:
      return call_text(formula);
    case Kind::brackets:
      return grown(part(0));
    case Kind::tuple:
      return "(" + part(0) + ")";
    case Kind::poisson:
      return "\\{" + part(0) + "\\}";
    case Kind::bold:
      return bold_text(formula.parts[0]);
    case Kind::dotted:
      return "\\dot{" + part(0) + "}";
    case Kind::primed:
      return part(0) + "'";
    case Kind::cross:
      return part(0) + " \\times " + part(1);
  }
  return {};
}

}  // namespace casimir::tools::typeset
