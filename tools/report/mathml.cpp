// Read by recursive descent. A formula becomes a list of pieces with places where a line may break:
// before + and - and after commas, also inside long brackets; never inside fractions and roots.
#include "tools/report/mathml.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>
#include <map>

#include "runtime/program/function_table.hpp"
#include "tools/report/html.hpp"

namespace casimir::tools {
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

const std::map<std::string, std::string>& letters() {
  static const std::map<std::string, std::string> kLetters = {
      {"alpha", "α"},      {"beta", "β"},   {"gamma", "γ"}, {"delta", "δ"},   {"epsilon", "ϵ"},
      {"varepsilon", "ε"}, {"zeta", "ζ"},   {"eta", "η"},   {"theta", "θ"},   {"iota", "ι"},
      {"kappa", "κ"},      {"lambda", "λ"}, {"mu", "μ"},    {"nu", "ν"},      {"xi", "ξ"},
      {"rho", "ρ"},        {"sigma", "σ"},  {"tau", "τ"},   {"upsilon", "υ"}, {"phi", "φ"},
      {"chi", "χ"},        {"psi", "ψ"},    {"omega", "ω"}, {"Gamma", "Γ"},   {"Delta", "Δ"},
      {"Theta", "Θ"},      {"Lambda", "Λ"}, {"Xi", "Ξ"},    {"Sigma", "Σ"},   {"Upsilon", "Υ"},
      {"Phi", "Φ"},        {"Psi", "Ψ"},    {"Omega", "Ω"}, {"pi", "π"},      {"partial", "∂"}};
  return kLetters;
}

/// Commands that are names of functions, each with the name as it is printed.
const std::map<std::string, std::string>& functions() {
  static const std::map<std::string, std::string> kFunctions = [] {
    std::map<std::string, std::string> names = {{"log", "log"}, {"arctan", "arctan"}};
    for (const FunctionRow& row : function_table()) {
      if (row.latex.find('{') != std::string_view::npos || row.op == Op::sqrt || row.latex.empty())
        continue;
      const std::string name(row.latex.substr(1));
      names.emplace(name, name);
    }
    return names;
  }();
  return kFunctions;
}

std::string element(const char* name, const std::string& inside) {
  return fmt::format("<{0}>{1}</{0}>", name, inside);
}

class Reader {
 public:
  explicit Reader(const std::string& latex) : text_(latex) {}

  Pieces all() {
    Pieces result;
    while (at_ < text_.size()) {
      for (Piece& piece : row("")) result.push_back(std::move(piece));
      if (at_ < text_.size()) put(result, {element("mo", html::text(text_.substr(at_++, 1))), 1});
    }
    return result;
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool take(const std::string& word) {
    skip_spaces();
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }

  bool at_end(const std::string& end) {
    skip_spaces();
    return at_ >= text_.size() || text_[at_] == '}' ||
           (!end.empty() && text_.compare(at_, end.size(), end) == 0);
  }

  static void put(Pieces& row, Piece piece) {
    if (row.empty() || piece.breaks_before) {
      row.push_back(std::move(piece));
      return;
    }
    row.back().markup += piece.markup;
    row.back().width += piece.width;
    row.back().tall = row.back().tall || piece.tall;
  }

  static void put(Pieces& row, const Pieces& pieces) {
    for (const Piece& piece : pieces) put(row, piece);
  }

  static Piece joined(const Pieces& row) {
    Piece result;
    for (const Piece& piece : row) {
      result.markup += piece.markup;
      result.width += piece.width;
      result.tall = result.tall || piece.tall;
    }
    return result;
  }

  static std::string one(const Pieces& row) { return element("mrow", joined(row).markup); }

  /// Up to `end`, a closing brace or the end of the text.
  Pieces row(const std::string& end) {
    Pieces result;
    bool after_operand = false, after_comma = false;
    while (!at_end(end)) {
      const char c = text_[at_];
      if (c == '+' || c == '-' || c == '=') {
        ++at_;
        const std::string sign = c == '-' ? "−" : std::string(1, c);
        put(result, {after_operand ? "<mo form=\"infix\">" + sign + "</mo>"
                                   : "<mo form=\"prefix\">" + sign + "</mo>",
                     2, after_operand || after_comma});
        after_operand = after_comma = false;
      } else if (c == ',') {
        ++at_;
        put(result, {"<mo separator=\"true\">,</mo>", 1});
        after_operand = false;
        after_comma = true;
      } else {
        Pieces next = scripted();
        if (after_comma && !next.empty()) next.front().breaks_before = true;
        put(result, next);
        after_operand = true;
        after_comma = false;
      }
    }
    return result;
  }

  /// An atom with what stands below and above it.
  Pieces scripted() {
    Pieces base = atom();
    std::string below, above;
    for (;;) {
      if (take("_"))
        below = argument().markup;
      else if (take("^"))
        above = argument().markup;
      else
        break;
    }
    if (below.empty() && above.empty()) return base;
    // Of brackets that are open to line breaks the closing one carries the power.
    std::string& markup = base.back().markup;
    const std::size_t at = base.size() > 1 ? markup.rfind("<mo") : 0;
    const std::string inner = element("mrow", markup.substr(at));
    markup.erase(at);
    markup += below.empty()   ? element("msup", inner + above)
              : above.empty() ? element("msub", inner + below)
                              : element("msubsup", inner + below + above);
    ++base.back().width;
    return base;
  }

  /// {..} or one atom, as one element.
  Piece argument() {
    if (take("{")) {
      const Pieces inside = row("");
      take("}");
      return {one(inside), joined(inside).width, false, joined(inside).tall};
    }
    const Piece inside = joined(atom());
    return {element("mrow", inside.markup), inside.width, false, inside.tall};
  }

  /// The letters between braces, as they are.
  std::string word() {
    std::string result;
    if (!take("{")) return result;
    while (at_ < text_.size() && text_[at_] != '}') {
      if (text_[at_] == '\\') ++at_;
      if (at_ < text_.size()) result += text_[at_++];
    }
    take("}");
    return result;
  }

  Pieces atom() {
    skip_spaces();
    if (at_ >= text_.size()) return {Piece{}};
    const char c = text_[at_];
    if (c == '\\') return command();
    if (c == '{') {
      const Piece inside = argument();
      return {inside};
    }
    const auto is = [&](int (*kind)(int)) {
      return at_ < text_.size() && kind(static_cast<unsigned char>(text_[at_])) != 0;
    };
    if (is(std::isdigit)) {
      std::string number;
      while (is(std::isdigit)) number += text_[at_++];
      return {{element("mn", number), number.size()}};
    }
    ++at_;
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      return {{element("mi", std::string(1, c)), 1}};
    return {{"<mo stretchy=\"false\">" + html::text(std::string(1, c)) + "</mo>", 1}};
  }

  Pieces command() {
    ++at_;
    std::string name;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0)
      name += text_[at_++];
    if (name.empty() && at_ < text_.size()) return symbol(text_[at_++]);
    if (const auto found = letters().find(name); found != letters().end())
      return {{element("mi", found->second), 1}};
    if (const auto found = functions().find(name); found != functions().end())
      return {{"<mi>" + found->second + "</mi>", 3}};
    if (name == "left") return brackets();
    return structure(name);
  }

  static Pieces symbol(char c) {
    if (c == ',' || c == ';' || c == ' ') return {{"<mspace width=\"0.3em\"/>", 1}};
    return {{"<mo stretchy=\"false\">" + html::text(std::string(1, c)) + "</mo>", 1}};
  }

  Pieces structure(const std::string& name) {
    if (name == "frac") {
      const Piece above = argument(), below = argument();
      return {{element("mfrac", above.markup + below.markup), std::max(above.width, below.width),
               false, true}};
    }
    if (name == "sqrt") {
      const Piece inside = argument();
      return {{element("msqrt", inside.markup), inside.width + 1, false, inside.tall}};
    }
    if (name == "boldsymbol") {
      const Piece inside = argument();
      return {{"<mrow class=\"vector\">" + inside.markup + "</mrow>", inside.width}};
    }
    if (name == "dot") {
      const Piece inside = argument();
      return {{"<mover accent=\"true\">" + inside.markup + "<mo stretchy=\"false\">˙</mo></mover>",
               inside.width}};
    }
    if (name == "mathrm" || name == "operatorname") {
      const std::string inside = word();
      return {{"<mi mathvariant=\"normal\">" + html::text(inside) + "</mi>", inside.size()}};
    }
    if (name == "text") {
      const std::string inside = word();
      return {{"<mtext>" + html::text(inside) + "</mtext>", inside.size()}};
    }
    if (name == "times") return {{"<mo>×</mo>", 2}};
    if (name == "quad") return {{"<mspace width=\"1em\"/>", 1}};
    return {{"<mtext>\\" + html::text(name) + "</mtext>", name.size() + 1}};
  }

  /// \left( .. \right): as high as what they hold, or, if that is long, open to line breaks.
  Pieces brackets() {
    skip_spaces();
    const std::string left = delimiter();
    const Pieces inside = row("\\right");
    take("\\right");
    const std::string right = delimiter();
    const Piece all = joined(inside);
    if (all.width < kLongBracket) {
      const char* mo = all.tall ? "<mo>" : "<mo stretchy=\"false\">";
      return {{"<mrow>" + (mo + left) + "</mo>" + all.markup + mo + right + "</mo></mrow>",
               all.width + 2, false, all.tall}};
    }
    Pieces result{{"<mo stretchy=\"false\" form=\"prefix\">" + left + "</mo>", 1}};
    for (std::size_t i = 0; i < inside.size(); ++i) {
      Piece piece = inside[i];
      piece.breaks_before = piece.breaks_before && i > 0;
      put(result, piece);
    }
    put(result, {"<mo stretchy=\"false\" form=\"postfix\">" + right + "</mo>", 1});
    return result;
  }

  std::string delimiter() {
    if (at_ >= text_.size()) return "";
    if (text_[at_] == '\\') ++at_;
    return at_ < text_.size() ? html::text(std::string(1, text_[at_++])) : "";
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

Pieces pieces_of(const std::string& latex) { return Reader(latex).all(); }

}  // namespace

std::string mathml(const std::string& latex) {
  std::string result;
  for (const Piece& piece : pieces_of(latex))
    result += (result.empty() ? "" : " ") + element("math", piece.markup);
  return result;
}

std::string mathml_matrix(const std::vector<std::vector<std::string>>& entries) {
  std::string rows;
  for (const auto& line : entries) {
    std::string cells;
    for (const std::string& entry : line) {
      std::string cell;
      for (const Piece& piece : pieces_of(entry)) cell += piece.markup;
      cells += element("mtd", cell);
    }
    rows += element("mtr", cells);
  }
  return "<math><mrow><mo>(</mo>" + element("mtable", rows) + "<mo>)</mo></mrow></math>";
}

}  // namespace casimir::tools
