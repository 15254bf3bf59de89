#include "tools/typeset/dag_math.hpp"

#include <cln/integer_io.h>
#include <cln/rational_io.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "runtime/program/function_table.hpp"
#include "symbolic/algebra/number_text.hpp"

namespace casimir::tools::typeset {
namespace {

using codegen::Dag;
using codegen::Factor;
using codegen::Node;
using codegen::NodeKind;
using codegen::Scaled;

Math integer(const cln::cl_I& n) { return number(rational_text(n)); }

/// Of a positive number.
Math rational_math(const cln::cl_RA& c) {
  const cln::cl_I below = cln::denominator(c);
  return below == 1 ? integer(cln::numerator(c))
                    : fraction(integer(cln::numerator(c)), integer(below));
}

/// Whether its first sign is a digit: beside what stands before it that would be another number.
bool begins_with_digit(const Math& formula) {
  if (formula.kind == Kind::scripts) return begins_with_digit(formula.parts[0]);
  return formula.kind == Kind::number;
}

/// Factors beside each other, with a dot before digits: 2 . 3^{1/3}.
Math factors_of(std::vector<Math> factors) {
  std::vector<Math> dotted;
  for (Math& factor : factors) {
    if (!dotted.empty() && begins_with_digit(factor)) dotted.push_back(symbol("cdot"));
    dotted.push_back(std::move(factor));
  }
  return product(std::move(dotted));
}

class Typesetter {
 public:
  using Names = std::function<Math(const std::string&)>;
  Typesetter(const Dag& dag, const Names& names) : dag_(dag), names_(names) {}

  Math scaled(const Scaled& e) const {
    const bool is_sum = e.node != Dag::kOne && dag_[e.node].kind == NodeKind::sum;
    if (is_sum && cln::abs(e.coefficient) == 1) return sum(dag_[e.node].terms, e.coefficient);
    // 1/2 (a + b) reads better than a/2 + b/2.
    Math positive = term({cln::abs(e.coefficient), e.node});
    return cln::minusp(e.coefficient) ? negated(std::move(positive)) : positive;
  }

 private:
  /// coefficient * node, for a positive coefficient.
  Math term(const Scaled& e) const {
    if (e.node == Dag::kOne) return rational_math(e.coefficient);
    const Node& node = dag_[e.node];
    if (node.kind == NodeKind::product) return product_of(node.factors, e.coefficient);
    if (e.coefficient == 1) return atom(node);
    Math factor = node.kind == NodeKind::sum ? in_brackets(atom(node)) : atom(node);
    return product({rational_math(e.coefficient), std::move(factor)});
  }

  Math sum(const std::vector<Scaled>& terms, const cln::cl_RA& factor) const {
    Math result{Kind::sum};
    for (const Scaled& t : terms) {
      const cln::cl_RA c = t.coefficient * factor;
      result.parts.push_back(term({cln::abs(c), t.node}));
      result.negative.push_back(cln::minusp(c));
    }
    return result;
  }

  std::vector<Factor> parameters_first(std::vector<Factor> factors) const {
    std::stable_partition(factors.begin(), factors.end(),
                          [this](const Factor& f) { return dag_.free_of_coordinates(f.node); });
    return factors;
  }

  Math product_of(const std::vector<Factor>& factors, const cln::cl_RA& coefficient) const {
    std::vector<Math> above, below;
    for (const Factor& f : parameters_first(factors))
      (cln::minusp(f.exponent) ? below : above)
          .push_back(power(dag_[f.node], cln::abs(f.exponent)));
    if (below.empty()) {
      if (coefficient != 1) above.insert(above.begin(), rational_math(coefficient));
      return factors_of(std::move(above));
    }
    const cln::cl_I top = cln::numerator(coefficient), bottom = cln::denominator(coefficient);
    if (top != 1 || above.empty()) above.insert(above.begin(), integer(top));
    if (bottom != 1) below.insert(below.begin(), integer(bottom));
    return fraction(factors_of(std::move(above)), factors_of(std::move(below)));
  }

  Math power(const Node& base, const cln::cl_RA& exponent) const {
    Math inner = atom(base);
    if (exponent == cln::cl_RA(1) / 2) return {Kind::root, {}, {std::move(inner)}};
    const bool compound = base.kind == NodeKind::sum || base.kind == NodeKind::product;
    if (compound) inner = in_brackets(std::move(inner));
    if (exponent == 1) return inner;
    Math power = number(rational_text(exponent));
    // sin^2(x), as people write it.
    if (base.kind == NodeKind::function && cln::denominator(exponent) == 1) {
      inner.parts[0] = std::move(power);
      return inner;
    }
    return with_power(std::move(inner), std::move(power));
  }

  Math atom(const Node& node) const {
    switch (node.kind) {
      case NodeKind::symbol:
        return names_(dag_.symbol_name(node.symbol));
      case NodeKind::pi:
        return symbol("pi");
      case NodeKind::number:
        return integer(node.number);
      case NodeKind::sum:
        return sum(node.terms, 1);
      case NodeKind::product:
        return product_of(node.factors, 1);
      default:
        break;
    }
    Math call{Kind::call, std::string(function_row(node.function).printed), {Math{}}};
    for (const Scaled& argument : node.terms) call.parts.push_back(scaled(argument));
    return call;
  }

  const Dag& dag_;
  const Names& names_;
};

}  // namespace

Math math(const Dag& dag, const Scaled& expression,
          const std::function<Math(const std::string&)>& names) {
  return Typesetter(dag, names).scaled(expression);
}

}  // namespace casimir::tools::typeset
