// A formula becomes a list of pieces with places where a line may break: before + and - and after
// commas, also inside long brackets; never inside fractions and roots.
#include "tools/typeset/mathml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "tools/typeset/html.hpp"

namespace casimir::tools::typeset {
namespace {

/// What stands between two places where a line may break.
struct Piece {
  std::string markup;
  std::size_t width = 0;  ///< roughly, in letters
  bool breaks_before = false;
  bool tall = false;  ///< higher than a line: brackets around it grow
};
using Pieces = std::vector<Piece>;

/// Brackets that hold less than this are kept together.
constexpr std::size_t kLongBracket = 24;

std::string letter_of(const std::string& name) {
  static const std::map<std::string, std::string> kLetters = {
      {"alpha", "α"},      {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},   {"epsilon", "ϵ"},
      {"varepsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},   {"theta", "θ"},   {"iota", "ι"},
      {"kappa", "κ"},      {"lambda", "λ"}, {"mu", "μ"},    {"nu", "ν"},      {"xi", "ξ"},
      {"rho", "ρ"},        {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"}, {"phi", "φ"},
      {"chi", "χ"},        {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},
      {"Theta", "Θ"},      {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Sigma", "Σ"},   {"Upsilon", "Υ"},
      {"Phi", "Φ"},        {"Psi", "Ψ"},    {"Omega", "Ω"}, {"pi", "π"},      {"partial", "∂"}};
  const auto found = kLetters.find(name);
  return found == kLetters.end() ? name : found->second;
}

std::string element(const char* name, const std::string& inside) {
  return fmt::format("<{0}>{1}</{0}>", name, inside);
}

std::string still(const std::string& sign) {
  return "<mo stretchy=\"false\">" + html::text(sign) + "</mo>";
}

void put(Pieces& row, Piece piece) {
  if (row.empty() || piece.breaks_before) {
    row.push_back(std::move(piece));
    return;
  }
  row.back().markup += piece.markup;
  row.back().width += piece.width;
  row.back().tall = row.back().tall || piece.tall;
}

void put(Pieces& row, const Pieces& pieces) {
  for (const Piece& piece : pieces) put(row, piece);
}

Piece joined(const Pieces& row) {
  Piece result;
  for (const Piece& piece : row) {
    result.markup += piece.markup;
    result.width += piece.width;
    result.tall = result.tall || piece.tall;
  }
  return result;
}

Pieces pieces_of(const Math& formula);

/// A part that lines do not break, as one element.
Piece unbroken(const Math& formula) {
  Piece piece = joined(pieces_of(formula));
  piece.markup = element("mrow", piece.markup);
  return piece;
}

Pieces letters(const std::string& text) {
  if (is_greek(text)) return {{element("mi", letter_of(text)), 1}};
  Piece piece;
  for (const char c : text) {
    piece.markup += element("mi", html::text(std::string(1, c)));
    ++piece.width;
  }
  return {piece};
}

Pieces sum(const Math& formula) {
  Pieces result;
  for (std::size_t i = 0; i < formula.parts.size(); ++i) {
    if (i > 0 || formula.negative[i]) {
      const std::string sign = formula.negative[i] ? "−" : "+";
      put(result,
          {fmt::format("<mo form=\"{}\">{}</mo>", i > 0 ? "infix" : "prefix", sign), 2, i > 0});
    }
    put(result, pieces_of(formula.parts[i]));
  }
  return result;
}

/// \param first  of the parts.
Pieces list(const Math& formula, std::size_t first) {
  Pieces result;
  for (std::size_t i = first; i < formula.parts.size(); ++i) {
    Pieces part = pieces_of(formula.parts[i]);
    if (i > first) {
      put(result, {"<mo separator=\"true\">,</mo>", 1});
      if (!part.empty()) part.front().breaks_before = true;
    }
    put(result, part);
  }
  return result;
}

Pieces scripts(const Math& formula) {
  Pieces base = pieces_of(formula.parts[0]);
  if (base.empty()) base.emplace_back();
  const bool below = !formula.parts[1].empty(), above = !formula.parts[2].empty();
  std::string beside;
  if (below) beside += unbroken(formula.parts[1]).markup;
  if (above) beside += unbroken(formula.parts[2]).markup;
  // Of brackets that are open to line breaks the closing one carries the power.
  std::string& markup = base.back().markup;
  const std::size_t at = base.size() > 1 ? markup.rfind("<mo") : 0;
  const std::string inner = element("mrow", markup.substr(at));
  markup.erase(at);
  markup += element(below && above ? "msubsup" : below ? "msub" : "msup", inner + beside);
  ++base.back().width;
  return base;
}

/// As high as what they hold, or, if that is long, open to line breaks.
Pieces brackets(const Pieces& inside) {
  const Piece all = joined(inside);
  if (all.width < kLongBracket) {
    const char* mo = all.tall ? "<mo>" : "<mo stretchy=\"false\">";
    return {{fmt::format("<mrow>{0}(</mo>{1}{0})</mo></mrow>", mo, all.markup), all.width + 2,
             false, all.tall}};
  }
  Pieces result{{"<mo stretchy=\"false\" form=\"prefix\">(</mo>", 1}};
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Piece piece = inside[i];
    piece.breaks_before = piece.breaks_before && i > 0;
    put(result, std::move(piece));
  }
  put(result, {"<mo stretchy=\"false\" form=\"postfix\">)</mo>", 1});
  return result;
}

Pieces call(const Math& formula) {
  Piece name{"<mi>" + formula.text + "</mi>", formula.text.size()};
  if (!formula.parts[0].empty())
    name.markup = element("msup", element("mrow", name.markup) + unbroken(formula.parts[0]).markup);
  Pieces result{name};
  put(result, brackets(list(formula, 1)));
  return result;
}

Pieces between(const char* left, const Math& inside, const char* right) {
  Pieces result{{still(left), 1}};
  put(result, pieces_of(inside));
  put(result, {still(right), 1});
  return result;
}

Pieces stacked(const Math& above, const Math& below) {
  const Piece top = unbroken(above), bottom = unbroken(below);
  return {{element("mfrac", top.markup + bottom.markup), std::max(top.width, bottom.width), false,
           true}};
}

/// Those kinds that change the look of one part.
Pieces changed(Kind kind, const Math& part) {
  const Piece inside = unbroken(part);
  switch (kind) {
    case Kind::root:
      return {{element("msqrt", inside.markup), inside.width + 1, false, inside.tall}};
    case Kind::bold:
      return {{"<mrow class=\"vector\">" + inside.markup + "</mrow>", inside.width}};
    case Kind::dotted:
      return {{"<mover accent=\"true\">" + inside.markup + "<mo stretchy=\"false\">˙</mo></mover>",
               inside.width}};
    default:
      return {{element("msup", inside.markup + "<mo>′</mo>"), inside.width + 1}};
  }
}

Pieces pieces_of(const Math& formula) {
  switch (formula.kind) {
    case Kind::letter:
      return letters(formula.text);
    case Kind::symbol:
      if (formula.text == "cdot") return {{"<mo>⋅</mo>", 1}};
      return {{element("mi", letter_of(formula.text)), 1}};
    case Kind::word:
      return {{"<mi mathvariant=\"normal\">" + html::text(formula.text) + "</mi>",
               formula.text.size()}};
    case Kind::number:
      return {{element("mn", formula.text), formula.text.size()}};
    case Kind::prose:
      return {{element("mtext", html::text(formula.text)), formula.text.size()}};
    case Kind::sum:
      return sum(formula);
    case Kind::list:
      return list(formula, 0);
    case Kind::fraction:
      return stacked(formula.parts[0], formula.parts[1]);
    case Kind::scripts:
      return scripts(formula);
    case Kind::call:
      return call(formula);
    case Kind::brackets:
      return brackets(pieces_of(formula.parts[0]));
    case Kind::tuple:
      return between("(", formula.parts[0], ")");
    case Kind::poisson:
      return between("{", formula.parts[0], "}");
    case Kind::product:
    case Kind::cross:
      break;
    default:
      return changed(formula.kind, formula.parts[0]);
  }
  Pieces result;
  for (const Math& part : formula.parts) {
    if (formula.kind == Kind::cross && !result.empty()) put(result, {"<mo>×</mo>", 2});
    put(result, pieces_of(part));
  }
  return result;
}

}  // namespace

std::string mathml(const Math& formula) {
  std::string result;
  for (const Piece& piece : pieces_of(formula))
    result += (result.empty() ? "" : " ") + element("math", piece.markup);
  return result;
}

std::string mathml(const MathMatrix& entries) {
  std::string rows;
  for (const std::vector<Math>& line : entries) {
    std::string cells;
    for (const Math& entry : line) cells += element("mtd", joined(pieces_of(entry)).markup);
    rows += element("mtr", cells);
  }
  return "<math><mrow><mo>(</mo>" + element("mtable", rows) + "<mo>)</mo></mrow></math>";
}

}  // namespace casimir::tools::typeset
