// Dag::latex: expressions as people typeset them.
#include <cln/integer_io.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <set>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/emit/number_literal.hpp"
#include "runtime/program/function_table.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::codegen {
namespace {

class Typesetter {
 public:
  using Names = std::function<std::string(const std::string&)>;
  Typesetter(const Dag& dag, const Names& names) : dag_(dag), names_(names) {}

  std::string scaled(const Scaled& e) const {
    if (e.node != Dag::kOne && dag_[e.node].kind == NodeKind::sum) {
      if (cln::abs(e.coefficient) == 1) return sum(dag_[e.node].terms, e.coefficient);
      // 1/2 (a + b) reads better than a/2 + b/2.
      return sign(e.coefficient) + term({cln::abs(e.coefficient), e.node});
    }
    return sign(e.coefficient) + term({cln::abs(e.coefficient), e.node});
  }

 private:
  static std::string sign(const cln::cl_RA& c) { return cln::minusp(c) ? "-" : ""; }

  static std::string number(const cln::cl_RA& c) {
    const cln::cl_I over = cln::denominator(c);
    if (over == 1) return rational_text(c);
    return "\\frac{" + rational_text(cln::numerator(c)) + "}{" + rational_text(over) + "}";
  }

  static std::string bracketed(const std::string& inner) { return "\\left(" + inner + "\\right)"; }

  /// coefficient * node, for a positive coefficient.
  std::string term(const Scaled& e) const {
    if (e.node == Dag::kOne) return number(e.coefficient);
    const Node& node = dag_[e.node];
    if (node.kind == NodeKind::product) return product(node.factors, e.coefficient);
    const std::string factor =
        node.kind == NodeKind::sum && e.coefficient != 1 ? bracketed(atom(node)) : atom(node);
    return e.coefficient == 1 ? factor : number(e.coefficient) + " " + factor;
  }

  std::string sum(const std::vector<Scaled>& terms, const cln::cl_RA& factor) const {
    std::string result;
    for (const Scaled& t : terms) {
      const cln::cl_RA c = t.coefficient * factor;
      if (result.empty())
        result = sign(c);
      else
        result += cln::minusp(c) ? " - " : " + ";
      result += term({cln::abs(c), t.node});
    }
    return result;
  }

  std::vector<Factor> parameters_first(std::vector<Factor> factors) const {
    std::stable_partition(factors.begin(), factors.end(),
                          [this](const Factor& f) { return dag_.free_of_coordinates(f.node); });
    return factors;
  }

  std::string product(const std::vector<Factor>& factors, const cln::cl_RA& coefficient) const {
    std::string above;
    std::string below;
    for (const Factor& f : parameters_first(factors)) {
      std::string& place = cln::minusp(f.exponent) ? below : above;
      if (!place.empty()) place += " ";
      place += power(dag_[f.node], cln::abs(f.exponent));
    }
    if (below.empty()) return coefficient == 1 ? above : number(coefficient) + " " + above;
    const std::string top = rational_text(cln::numerator(coefficient));
    const std::string bottom = rational_text(cln::denominator(coefficient));
    return "\\frac{" + (above.empty() ? top : (top == "1" ? "" : top + " ") + above) + "}{" +
           (bottom == "1" ? "" : bottom + " ") + below + "}";
  }

  std::string power(const Node& base, const cln::cl_RA& exponent) const {
    const std::string inner = atom(base);
    if (exponent == cln::cl_RA(1) / 2) return "\\sqrt{" + inner + "}";
    // sin^2(x), as people write it.
    if (base.kind == NodeKind::function && exponent != 1 && cln::denominator(exponent) == 1) {
      const std::size_t end = inner.find("\\left(");
      return inner.substr(0, end) + "^{" + rational_text(exponent) + "}" + inner.substr(end);
    }
    const bool compound = base.kind == NodeKind::sum || base.kind == NodeKind::product;
    const std::string shell = compound ? bracketed(inner) : inner;
    return exponent == 1 ? shell : shell + "^{" + rational_text(exponent) + "}";
  }

  std::string atom(const Node& node) const {
    switch (node.kind) {
      case NodeKind::symbol:
        return names_ ? names_(dag_.symbol_name(node.symbol))
                      : latex_name(dag_.symbol_name(node.symbol));
      case NodeKind::pi:
        return "\\pi";
      case NodeKind::number:
        return rational_text(node.number);
      case NodeKind::sum:
        return sum(node.terms, 1);
      case NodeKind::product:
        return product(node.factors, 1);
      default:
        break;
    }
    std::string inside;
    for (const Scaled& argument : node.terms)
      inside += (inside.empty() ? "" : ", ") + scaled(argument);
    return std::string(function_row(node.function).latex) + bracketed(inside);
  }

  const Dag& dag_;
  const Names& names_;
};

/// A part of a name: a Greek letter, one letter, or a word set upright.
std::string latex_word(const std::string& word) {
  static const std::set<std::string> kGreek = {
      "alpha", "beta",    "gamma",  "delta", "epsilon", "zeta",  "eta",   "theta",
      "iota",  "kappa",   "lambda", "mu",    "nu",      "xi",    "rho",   "sigma",
      "tau",   "upsilon", "phi",    "chi",   "psi",     "omega", "Gamma", "Delta",
      "Theta", "Lambda",  "Xi",     "Sigma", "Upsilon", "Phi",   "Psi",   "Omega"};
  if (kGreek.contains(word)) return "\\" + word;
  return word.size() <= 1 ? word : "\\mathrm{" + word + "}";
}

}  // namespace

std::string latex_name(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    const bool digit = c >= '0' && c <= '9';
    const bool was_digit =
        !parts.back().empty() && parts.back().back() >= '0' && parts.back().back() <= '9';
    if (c == '_' || (digit != was_digit && !parts.back().empty())) parts.emplace_back();
    if (c != '_') parts.back() += c;
  }
  std::string index;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    const bool digits = parts[i][0] >= '0' && parts[i][0] <= '9';
    index += (index.empty() ? "" : " ") + (digits ? parts[i] : latex_word(parts[i]));
  }
  const std::string head = latex_word(parts[0]);
  return index.empty() ? head : head + "_{" + index + "}";
}

std::string Dag::latex(const Scaled& expression,
                       const std::function<std::string(const std::string&)>& typeset) const {
  return Typesetter(*this, typeset).scaled(expression);
}

}  // namespace casimir::codegen
