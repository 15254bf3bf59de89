// Dag::text: expressions in the notation of case files.
#include <cln/integer_io.h>
#include <cln/rational_io.h>

#include <map>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/emit/number_literal.hpp"
#include "runtime/program/function_table.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::codegen {

namespace {

/// How tightly the outermost operation of a text binds.
enum TextBinding { kTextSum, kTextProduct, kTextPower, kTextAtom };

struct Text {
  std::string text;
  TextBinding binding;
};

std::string at_least(TextBinding needed, const Text& part) {
  return part.binding < needed ? "(" + part.text + ")" : part.text;
}

class Printer {
 public:
  explicit Printer(const Dag& dag) : dag_(dag) {}

  Text scaled(const Scaled& e) const {
    if (e.node != Dag::kOne && dag_[e.node].kind == NodeKind::sum && e.coefficient != 1) {
      return sum(dag_[e.node].terms, e.coefficient);
    }
    if (cln::minusp(e.coefficient)) {
      return {"-" + at_least(kTextProduct, magnitude(e)), kTextSum};
    }
    return magnitude(e);
  }

 private:
  /// |coefficient| * node, as "2*x/3".
  Text magnitude(const Scaled& e) const {
    const cln::cl_RA size = cln::abs(e.coefficient);
    const std::string over = rational_text(cln::denominator(size));
    if (e.node == Dag::kOne) return {rational_text(size), over == "1" ? kTextAtom : kTextProduct};
    Text result = node(e.node, cln::numerator(size));
    if (over == "1") return result;
    return {at_least(kTextProduct, result) + "/" + over, kTextProduct};
  }

  Text node(NodeId id, const cln::cl_I& multiple) const {
    const Node& n = dag_[id];
    if (n.kind == NodeKind::product) return product(n.factors, multiple);
    const Text plain = atom(n);
    if (multiple == 1) return plain;
    return {rational_text(multiple) + "*" + at_least(kTextPower, plain), kTextProduct};
  }

  Text atom(const Node& n) const {
    switch (n.kind) {
      case NodeKind::symbol:
        return {dag_.symbol_name(n.symbol), kTextAtom};
      case NodeKind::pi:
        return {"Pi", kTextAtom};
      case NodeKind::number:
        return {rational_text(n.number), kTextAtom};
      case NodeKind::sum:
        return sum(n.terms, 1);
      case NodeKind::product:
        return product(n.factors, 1);
      default:
        break;
    }
    std::string inside;
    for (const Scaled& argument : n.terms) {
      inside += (inside.empty() ? "" : ", ") + scaled(argument).text;
    }
    return {std::string(function_row(n.function).name) + "(" + inside + ")", kTextAtom};
  }

  Text sum(const std::vector<Scaled>& terms, const cln::cl_RA& factor) const {
    std::string result;
    for (const Scaled& term : terms) {
      const cln::cl_RA coefficient = term.coefficient * factor;
      const bool minus = cln::minusp(coefficient);
      if (result.empty()) {
        result = minus ? "-" : "";
      } else {
        result += minus ? " - " : " + ";
      }
      result += at_least(kTextProduct, magnitude({coefficient, term.node}));
    }
    return {result, kTextSum};
  }

  Text product(const std::vector<Factor>& factors, const cln::cl_I& multiple) const {
    std::string above = multiple == 1 ? "" : rational_text(multiple);
    std::string below;
    int divisors = 0;
    for (const Factor& f : factors) {
      const bool inverse = cln::minusp(f.exponent);
      std::string& place = inverse ? below : above;
      divisors += inverse ? 1 : 0;
      if (!place.empty()) place += "*";
      place += power(dag_[f.node], cln::abs(f.exponent));
    }
    if (above.empty()) above = "1";
    if (divisors == 0) return {above, kTextProduct};
    return {above + "/" + (divisors > 1 ? "(" + below + ")" : below), kTextProduct};
  }

  std::string power(const Node& base, const cln::cl_RA& exponent) const {
    const Text inner = atom(base);
    if (exponent == 1) return at_least(kTextPower, inner);
    if (exponent == cln::cl_RA(1) / 2) return "sqrt(" + inner.text + ")";
    const bool whole = cln::denominator(exponent) == 1;
    return at_least(kTextAtom, inner) + "^" +
           (whole ? rational_text(exponent) : "(" + rational_text(exponent) + ")");
  }

  const Dag& dag_;
};

/// How many parts the tree has that a text would show: parts that are shared count each time.
double tree_size(const Dag& dag, NodeId id, std::map<NodeId, double>& known) {
  if (const auto found = known.find(id); found != known.end()) return found->second;
  double size = 1;
  for (const Scaled& term : dag[id].terms) size += tree_size(dag, term.node, known);
  for (const Factor& factor : dag[id].factors) size += tree_size(dag, factor.node, known);
  return known[id] = size;
}

}  // namespace

std::string Dag::text(const Scaled& expression) const {
  // Elliptic functions by their means and duplications are small as graphs and no texts.
  constexpr double kLongest = 1e5;
  std::map<NodeId, double> known;
  if (tree_size(*this, expression.node, known) > kLongest) return "(too long to be written)";
  return Printer(*this).scaled(expression).text;
}

}  // namespace casimir::codegen
