#include "codegen/optimise/terms.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "symbolic/error.hpp"

namespace casimir::codegen {

namespace {

/// An integer exponent as a machine number.
int small(const cln::cl_RA& value) {
  constexpr int kLargestExponent = 100'000;
  if (cln::abs(value) > kLargestExponent) throw ModelError("an exponent is too large to compute");
  return cln::cl_I_to_int(cln::numerator(value));
}

/// Orders polynomials for look-up only.
struct PolynomialLess {
  bool operator()(const Polynomial& a, const Polynomial& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                        [](const Term& s, const Term& t) {
                                          if (s.monomial != t.monomial)
                                            return s.monomial < t.monomial;
                                          return s.coefficient < t.coefficient;
                                        });
  }
};

class Builder {
 public:
  Builder(const Dag& dag, std::size_t inputs) : dag_(dag) {
    system_.inputs = inputs;
    for (std::size_t i = 0; i < inputs; ++i) {
      Variable input;
      input.input = static_cast<int>(i);
      system_.variables.push_back(input);
    }
  }

  TermSystem build(const std::vector<Scaled>& outputs) {
    for (const Scaled& output : outputs) find_powers(output.node);
    for (const Scaled& output : outputs) {
      Variable variable;
      variable.kind = Variable::Kind::polynomial;
      variable.value = polynomial_of(output);
      system_.outputs.push_back(system_.add(std::move(variable)));
    }
    return std::move(system_);
  }

 private:
  /// Bases with a power such as -1/2: their other negative powers are powers of that one. Of the
  /// exponents 1/3, -2/3, .. of a base the least: the others are a multiple by whole powers.
  void find_powers(NodeId id) {
    if (!visited_.insert(id).second) return;
    for (const Scaled& t : dag_[id].terms) find_powers(t.node);
    for (const Factor& f : dag_[id].factors) {
      if (cln::denominator(f.exponent) == 2 && cln::minusp(f.exponent)) {
        inverse_roots_.insert(f.node);
      }
      const auto [least, is_new] = least_powers_.try_emplace(broken_power(f), f.exponent);
      if (f.exponent < least->second) least->second = f.exponent;
      find_powers(f.node);
    }
  }

  /// The base, and the exponent without its whole part.
  static std::pair<NodeId, cln::cl_RA> broken_power(const Factor& f) {
    return {f.node, f.exponent - cln::floor1(f.exponent)};
  }

  Polynomial polynomial_of(const Scaled& e) {
    if (e.coefficient == 0) return {};
    if (dag_[e.node].kind != NodeKind::sum) return {term_of(e)};
    Polynomial result;
    Polynomial constants;
    for (const Scaled& t : dag_[e.node].terms) {
      const Scaled part{t.coefficient * e.coefficient, t.node};
      (dag_[t.node].constant ? constants : result).push_back(term_of(part));
    }
    if (constants.size() > 1 && !result.empty()) {  // one literal for all of them
      result.push_back({1, {{constant(std::move(constants)), 1}}});
    } else {
      result.insert(result.end(), constants.begin(), constants.end());
    }
    return result;
  }

  Term term_of(const Scaled& e) {
    Monomial all;
    if (dag_[e.node].kind == NodeKind::product) {
      for (const Factor& f : dag_[e.node].factors) all = multiply(all, literals_of(f));
    } else if (e.node != Dag::kOne) {
      all = {{variable_of(e.node), 1}};
    }
    all = joined_moduli(all);
    Monomial fixed;
    Monomial varying;
    for (const VariablePower& l : all) {
      (system_.variables[static_cast<std::size_t>(l.variable)].constant ? fixed : varying)
          .push_back(l);
    }
    if (fixed.empty() || (varying.empty() && fixed.size() == 1)) return {e.coefficient, all};
    if (fixed.size() == 1 && fixed[0].exponent == 1 && cln::abs(e.coefficient) == 1) {
      return {e.coefficient, all};
    }
    const cln::cl_RA sign = cln::minusp(e.coefficient) ? -1 : 1;
    const int factor = constant({{cln::abs(e.coefficient), fixed}});
    return {sign, multiply(varying, {{factor, 1}})};
  }

  Monomial literals_of(const Factor& f) {
    const bool half = cln::denominator(f.exponent) == 2;
    if (!is_integer(f.exponent) && is_square(f.node)) return root_of_square(f);
    const int base = variable_of(f.node);
    if (is_integer(f.exponent) && cln::plusp(f.exponent)) return {{base, small(f.exponent)}};
    if (cln::minusp(f.exponent) && inverse_roots_.contains(f.node) &&
        (half || is_integer(f.exponent))) {
      const int inverse = function(Op::div, {function(Op::sqrt, {base})});
      return {{inverse, small(-2 * f.exponent)}};
    }
    if (is_integer(f.exponent)) return {{function(Op::div, {base}), small(-f.exponent)}};
    const cln::cl_RA least = half ? cln::cl_RA(1) / 2 : least_powers_.at(broken_power(f));
    const cln::cl_RA whole = f.exponent - least;
    const Monomial root{{half ? function(Op::sqrt, {base}) : function(Op::pow, {base}, least), 1}};
    return whole == 0 ? root : multiply(root, {{base, small(whole)}});
  }

  /// Whether it is a product of even powers of what varies.
  bool is_square(NodeId id) const {
    const Node& node = dag_[id];
    return node.kind == NodeKind::product && !node.constant &&
           std::ranges::all_of(node.factors,
                               [](const Factor& f) { return is_integer(f.exponent / 2); });
  }

  /// The root of a square is |.|, whose derivative exists wherever that is not zero and whose
  /// series is that of the other factor; another broken power of a square is one of |.|.
  Monomial root_of_square(const Factor& f) {
    Monomial result;
    for (const Factor& inner : dag_[f.node].factors) {
      const cln::cl_RA exponent = inner.exponent * f.exponent;
      if (!is_integer(exponent)) {
        const int modulus = function(Op::abs, {variable_of(inner.node)});
        result = multiply(result, {{function(Op::pow, {modulus}, exponent), 1}});
        continue;
      }
      const bool odd = cln::oddp(cln::numerator(exponent));
      int base = variable_of(inner.node);
      if (odd) base = function(Op::abs, {base});
      if (cln::minusp(exponent)) base = function(Op::div, {base});
      result = multiply(result, {{base, small(cln::abs(exponent))}});
    }
    return result;
  }

  /// x / |x| and |x| / x are sign(x), which has a value where x is zero, and so has x^3 / |x| =
  /// x |x|.
  Monomial joined_moduli(const Monomial& all) {
    Monomial result = all;
    for (const VariablePower& l : all) {
      const int divisor = argument_of(l.variable, Op::div);
      if (divisor < 0) continue;
      const int inside = argument_of(divisor, Op::abs);
      const int base = inside >= 0 ? inside : divisor;
      const int other = inside >= 0 ? base : modulus_in(result, base);
      const int power = other >= 0 ? exponent_of(result, other) : 0;
      if (power == 0) continue;
      std::erase_if(result, [&](const VariablePower& factor) {
        return factor.variable == l.variable || factor.variable == other;
      });
      const int rest = power - l.exponent;
      // Of an odd number of signs one is left, and joins a factor that there is.
      const bool odd = std::min(power, l.exponent) % 2 == 1, joins = odd && rest > 0;
      const auto put = [&](int variable, int exponent) {
        if (exponent > 0) result = multiply(result, {{variable, exponent}});
      };
      put(l.variable, -rest);
      put(other, joins ? rest - 1 : rest);
      if (joins)
        put(inside >= 0 ? divisor : base, 1);
      else if (odd)
        put(function(Op::sign, {base}), 1);
    }
    return result;
  }

  /// The argument of this function, or -1 where the variable is something else.
  int argument_of(int variable, Op op) const {
    const Variable& v = system_.variables[static_cast<std::size_t>(variable)];
    return v.kind == Variable::Kind::function && v.function == op ? v.arguments[0] : -1;
  }

  /// The factor |base|, or -1.
  int modulus_in(const Monomial& monomial, int base) const {
    for (const VariablePower& l : monomial)
      if (argument_of(l.variable, Op::abs) == base) return l.variable;
    return -1;
  }

  static int exponent_of(const Monomial& monomial, int variable) {
    const auto found = std::ranges::find(monomial, variable, &VariablePower::variable);
    return found == monomial.end() ? 0 : found->exponent;
  }

  int variable_of(NodeId id) {
    if (const auto found = of_node_.find(id); found != of_node_.end()) return found->second;
    const int result = new_variable_of(id);
    of_node_.emplace(id, result);
    return result;
  }

  int new_variable_of(NodeId id) {
    const Node& node = dag_[id];
    switch (node.kind) {
      case NodeKind::symbol:
        return node.symbol;
      case NodeKind::pi: {
        Variable pi;
        pi.kind = Variable::Kind::pi;
        pi.constant = true;
        return system_.add(std::move(pi));
      }
      case NodeKind::number:
        return constant({{node.number, {}}});
      case NodeKind::function: {
        std::vector<int> arguments;
        for (const Scaled& t : node.terms) arguments.push_back(argument(t));
        return function(node.function, std::move(arguments));
      }
      default:
        return polynomial({1, id});
    }
  }

  int argument(const Scaled& e) {
    const NodeKind kind = dag_[e.node].kind;
    const bool plain = kind != NodeKind::one && kind != NodeKind::product;
    return plain && e.coefficient == 1 ? variable_of(e.node) : polynomial(e);
  }

  int polynomial(const Scaled& e) {
    Polynomial value = polynomial_of(e);
    if (dag_[e.node].constant) return constant(std::move(value));
    if (value.size() == 1 && value[0].coefficient == 1 && value[0].monomial.size() == 1 &&
        value[0].monomial[0].exponent == 1) {
      return value[0].monomial[0].variable;
    }
    return unique(std::move(value), false);
  }

  int constant(Polynomial value) { return unique(std::move(value), true); }

  int unique(Polynomial value, bool is_constant) {
    const auto [place, is_new] = polynomials_.try_emplace(value, -1);
    if (is_new) {
      Variable variable;
      variable.kind = Variable::Kind::polynomial;
      variable.value = std::move(value);
      variable.constant = is_constant;
      place->second = system_.add(std::move(variable));
    }
    return place->second;
  }

  int function(Op op, std::vector<int> arguments, const cln::cl_RA& exponent = 1) {
    const auto key =
        std::make_tuple(op, arguments, cln::numerator(exponent), cln::denominator(exponent));
    if (const auto found = functions_.find(key); found != functions_.end()) return found->second;
    Variable variable;
    variable.kind = Variable::Kind::function;
    variable.function = op;
    variable.exponent = exponent;
    variable.constant = std::ranges::all_of(arguments, [this](int argument) {
      return system_.variables[static_cast<std::size_t>(argument)].constant;
    });
    variable.arguments = std::move(arguments);
    return functions_[key] = system_.add(std::move(variable));
  }

  const Dag& dag_;
  TermSystem system_;
  std::set<NodeId> visited_;
  std::set<NodeId> inverse_roots_;
  std::map<std::pair<NodeId, cln::cl_RA>, cln::cl_RA> least_powers_;
  std::map<NodeId, int> of_node_;
  std::map<Polynomial, int, PolynomialLess> polynomials_;
  std::map<std::tuple<Op, std::vector<int>, cln::cl_I, cln::cl_I>, int> functions_;
};

}  // namespace

int TermSystem::add(Variable variable) {
  variables.push_back(std::move(variable));
  return static_cast<int>(variables.size()) - 1;
}

Monomial multiply(const Monomial& a, const Monomial& b) {
  Monomial result;
  auto left = a.begin();
  auto right = b.begin();
  while (left != a.end() || right != b.end()) {
    if (right == b.end() || (left != a.end() && left->variable < right->variable)) {
      result.push_back(*left++);
    } else if (left == a.end() || right->variable < left->variable) {
      result.push_back(*right++);
    } else {
      result.push_back({left->variable, left->exponent + right->exponent});
      ++left;
      ++right;
    }
  }
  return result;
}

TermSystem system_of(const Dag& dag, std::size_t inputs, const std::vector<Scaled>& outputs) {
  return Builder(dag, inputs).build(outputs);
}

}  // namespace casimir::codegen
