#include "codegen/dag/expression_dag.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "codegen/dag/elliptic_nodes.hpp"
#include "runtime/program/function_table.hpp"
#include "symbolic/algebra/ball_evaluator.hpp"
#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/elliptic.hpp"

namespace casimir::codegen {

namespace {

cln::cl_RA exact_value(const GiNaC::ex& expression) {
  const auto& number = GiNaC::ex_to<GiNaC::numeric>(expression);
  if (!number.is_real()) {
    throw ModelError("the imaginary number " + expression_text(expression) +
                     " appears: every expression must be real");
  }
  if (!number.is_rational()) {
    throw ModelError("the number " + expression_text(expression) + " is not exact");
  }
  return cln::the<cln::cl_RA>(number.to_cl_N());
}

std::size_t mix(std::size_t seed, std::size_t value) {
  return seed ^ (value + 0x9e3779b97f4a7c15ULL + (seed << 6) + (seed >> 2));
}

std::size_t hash_of(const Node& node) {
  std::size_t h = mix(static_cast<std::size_t>(node.kind), static_cast<std::size_t>(node.symbol));
  h = mix(h, static_cast<std::size_t>(node.function));
  h = mix(h, cln::equal_hashcode(node.number));
  for (const Scaled& t : node.terms) {
    h = mix(mix(h, cln::equal_hashcode(t.coefficient)), static_cast<std::size_t>(t.node));
  }
  for (const Factor& f : node.factors) {
    h = mix(mix(h, cln::equal_hashcode(f.exponent)), static_cast<std::size_t>(f.node));
  }
  return h;
}

bool same(const Node& a, const Node& b) {
  const auto same_term = [](const Scaled& s, const Scaled& t) {
    return s.node == t.node && s.coefficient == t.coefficient;
  };
  const auto same_factor = [](const Factor& s, const Factor& t) {
    return s.node == t.node && s.exponent == t.exponent;
  };
  return a.kind == b.kind && a.symbol == b.symbol && a.function == b.function &&
         a.number == b.number && std::ranges::equal(a.terms, b.terms, same_term) &&
         std::ranges::equal(a.factors, b.factors, same_factor);
}

/// Splits the q-th powers of small numbers off, as in 72 = 2 * 6^2, and returns their root.
cln::cl_I divide_out_powers(cln::cl_I& integer, const cln::cl_I& q) {
  constexpr int kLargestFactor = 100;
  cln::cl_I root = 1;
  if (q > 64) return root;
  for (int factor = 2; factor <= kLargestFactor; ++factor) {
    const cln::cl_I power = cln::expt_pos(cln::cl_I(factor), q);
    while (integer >= power && cln::mod(integer, power) == 0) {
      integer = cln::exquo(integer, power);
      root = root * factor;
    }
  }
  return root;
}

}  // namespace

Dag::Dag(std::vector<GiNaC::symbol> symbols, std::size_t coordinates)
    : Dag(symbols, [&] {
        std::vector<int> degrees(symbols.size());
        std::fill_n(degrees.begin(), std::min(coordinates, symbols.size()), 1);
        return degrees;
      }()) {}

Dag::Dag(std::vector<GiNaC::symbol> symbols, std::vector<int> degrees)
    : degrees_(std::move(degrees)) {
  nodes_.emplace_back();
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    names_.push_back(symbols[i].get_name());
    ranks_[symbols[i]] = static_cast<int>(i);
  }
}

const std::string& Dag::symbol_name(int symbol) const {
  return names_[static_cast<std::size_t>(symbol)];
}

bool Dag::contains(const Scaled& expression, int symbol) const {
  std::vector<bool> seen(nodes_.size(), false);
  std::vector<NodeId> open{expression.node};
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const Node& node = (*this)[id];
    if (node.kind == NodeKind::symbol && node.symbol == symbol) return true;
    if (node.constant || seen[static_cast<std::size_t>(id)]) continue;
    seen[static_cast<std::size_t>(id)] = true;
    for (const Scaled& t : node.terms) open.push_back(t.node);
    for (const Factor& f : node.factors) open.push_back(f.node);
  }
  return false;
}

bool Dag::free_of_coordinates(NodeId id) const {
  const Node& node = (*this)[id];
  if (node.kind == NodeKind::symbol) return degrees_[static_cast<std::size_t>(node.symbol)] == 0;
  return node.constant ||
         (std::ranges::all_of(node.terms,
                              [this](const Scaled& t) { return free_of_coordinates(t.node); }) &&
          std::ranges::all_of(node.factors,
                              [this](const Factor& f) { return free_of_coordinates(f.node); }));
}

// ------------------------------------------------------------------------------------ conversion

Scaled Dag::convert(const GiNaC::ex& expression) {
  if (const auto found = converted_.find(expression); found != converted_.end()) {
    return found->second;
  }
  const Scaled result = convert_new(expression);
  converted_.emplace(expression, result);
  return result;
}

namespace {

/// A product in two parts: even powers, and all that is not.
struct EvenPowers {
  GiNaC::ex even = 1, rest = 1;
};

/// A sum of a few products with the squares in it apart, in its variables or functions of these, as
/// of sin(x)^2 + sin(x)^4.
GiNaC::ex square_free(const GiNaC::ex& factor) {
  constexpr std::size_t kMostTerms = 30;
  if (!GiNaC::is_a<GiNaC::add>(factor) || factor.nops() > kMostTerms) return factor;
  GiNaC::exmap functions;
  const GiNaC::ex polynomial = factor.to_polynomial(functions);
  if (!polynomial.info(GiNaC::info_flags::rational_polynomial)) return factor;
  return GiNaC::sqrfree(polynomial).subs(functions, GiNaC::subs_options::no_pattern);
}

/// Of a broken power the base with the squares in it apart, multiplied out as it may be: the root
/// of x^2 + x^4 is |x| sqrt(1 + x^2), which turns at 0 as a root that does not vanish never does.
EvenPowers even_powers(const GiNaC::ex& base) {
  GiNaC::ex split = 1;
  if (GiNaC::is_a<GiNaC::mul>(base))
    for (const GiNaC::ex& factor : base) split *= square_free(factor);
  else
    split = square_free(base);
  EvenPowers parts;
  const auto put = [&](const GiNaC::ex& factor) {
    const bool is_even =
        GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::even);
    (is_even ? parts.even : parts.rest) *= factor;
  };
  if (GiNaC::is_a<GiNaC::mul>(split))
    for (const GiNaC::ex& factor : split) put(factor);
  else
    put(split);
  // As it is written, where there is no square in it.
  return parts.even.is_equal(1) ? EvenPowers{1, base} : parts;
}

/// The modulus of one of Jacobi's functions, to many digits where it is a number.
std::optional<cln::cl_RA> constant_modulus(const GiNaC::ex& e) {
  if (e.nops() != 2) return std::nullopt;
  if (GiNaC::is_a<GiNaC::numeric>(e.op(1))) return exact_value(e.op(1));
  constexpr long kBits = 600;
  try {
    BallEvaluator evaluate(BallEvaluator::Numbers::real, kBits);
    const Ball value = evaluate(e.op(1));
    Rational middle;
    arf_get_fmpq(middle.get(), arb_midref(acb_realref(value.raw())));
    return middle.number();
  } catch (const NotCertified&) {  // it is none, or has no value
    return std::nullopt;
  }
}

}  // namespace

Scaled Dag::convert_new(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return {exact_value(e), kOne};
  if (GiNaC::is_a<GiNaC::symbol>(e)) {
    const auto rank = ranks_.find(e);
    if (rank == ranks_.end()) throw ModelError("unknown symbol '" + expression_text(e) + "'");
    return symbol(rank->second);
  }
  if (e.is_equal(GiNaC::Pi)) return pi();
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    std::vector<Scaled> parts;
    for (const GiNaC::ex& part : e) parts.push_back(convert(part));
    return GiNaC::is_a<GiNaC::add>(e) ? sum(parts) : product(parts);
  }
  if (GiNaC::is_a<GiNaC::power>(e)) {
    if (GiNaC::is_a<GiNaC::numeric>(e.op(1))) return convert_power(e.op(0), exact_value(e.op(1)));
    return call(Op::exp, {product({convert(e.op(1)), call(Op::log, {convert(e.op(0))})})});
  }
  if (GiNaC::is_a<GiNaC::function>(e)) return convert_function(e);
  throw ModelError("cannot compute '" + expression_text(e) + "'");
}

Scaled Dag::convert_power(const GiNaC::ex& base, const cln::cl_RA& exponent) {
  if (is_integer(exponent)) return power(convert(base), exponent);
  const EvenPowers parts = even_powers(base);
  const Scaled rest = power(convert(parts.rest), exponent);
  return parts.even.is_equal(1) ? rest : product({power(convert(parts.even), exponent), rest});
}

Scaled Dag::convert_function(const GiNaC::ex& e) {
  // Powers, roots and |x| are no functions of GiNaC here; atan(y) is atan2(y, 1).
  const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
  const auto row = std::ranges::find_if(function_table(), [&](const FunctionRow& known) {
    return known.name == (name == "atan" ? "atan2" : name) && known.op != Op::pow &&
           known.op != Op::sqrt && known.op != Op::abs && known.op != Op::sign;
  });
  if (casimir::as_arbitrary(GiNaC::ex_to<GiNaC::function>(e)) || name.starts_with("arbitrary"))
    throw ModelError("the function in '" + expression_text(e) +
                     "' is arbitrary: a scene gives it, functions = { .. }");
  const bool elliptic = is_elliptic_function(GiNaC::ex_to<GiNaC::function>(e));
  if (row == function_table().end() && !elliptic)
    throw ModelError("unknown function '" + name + "'");
  std::vector<Scaled> arguments;
  for (const GiNaC::ex& argument : e) arguments.push_back(convert(argument));
  if (elliptic) return elliptic_node(*this, name, arguments, constant_modulus(e));
  if (name == "atan") arguments.push_back({1, kOne});
  return call(row->op, std::move(arguments));
}

// ---------------------------------------------------------------------------------- construction

Scaled Dag::symbol(int index) {
  Node node;
  node.kind = NodeKind::symbol;
  node.symbol = index;
  return {1, intern(std::move(node))};
}

Scaled Dag::pi() {
  Node node;
  node.kind = NodeKind::pi;
  return {1, intern(std::move(node))};
}

Scaled Dag::sum(const std::vector<Scaled>& terms) {
  std::map<NodeId, cln::cl_RA> collected;
  const auto collect = [&](NodeId node, const cln::cl_RA& coefficient) {
    const auto [place, is_new] = collected.try_emplace(node, coefficient);
    if (!is_new) place->second = place->second + coefficient;
  };
  for (const Scaled& term : terms) {
    if ((*this)[term.node].kind != NodeKind::sum) {
      collect(term.node, term.coefficient);
      continue;
    }
    for (const Scaled& inner : (*this)[term.node].terms) {
      collect(inner.node, term.coefficient * inner.coefficient);
    }
  }
  std::vector<Scaled> result;
  for (const auto& [node, coefficient] : collected) {
    if (coefficient != 0) result.push_back({coefficient, node});
  }
  std::ranges::sort(
      result, [this](const Scaled& a, const Scaled& b) { return compare(a.node, b.node) < 0; });
  if (result.empty()) return {0, kOne};
  if (result.size() == 1) return result.front();
  return primitive_sum(std::move(result));
}

Scaled Dag::primitive_sum(std::vector<Scaled> terms) {
  cln::cl_I divisor = 0;
  cln::cl_I multiple = 1;
  for (const Scaled& t : terms) {
    divisor = cln::gcd(divisor, cln::numerator(t.coefficient));
    multiple = cln::lcm(multiple, cln::denominator(t.coefficient));
  }
  cln::cl_RA content = divisor / multiple;
  if (cln::minusp(terms.front().coefficient)) content = -content;
  // Beyond every number type, coefficients are brought below 1; by a square, which has a root.
  constexpr unsigned long kMostBits = 100;
  unsigned long bits = 0;
  for (const Scaled& t : terms)
    bits = std::max(bits, cln::integer_length(cln::numerator(t.coefficient / content)));
  if (bits > kMostBits) content = content * cln::ash(1, static_cast<long>(bits + bits % 2));
  Node node;
  node.kind = NodeKind::sum;
  for (const Scaled& t : terms) node.terms.push_back({t.coefficient / content, t.node});
  return {content, intern(std::move(node))};
}

Scaled Dag::product(const std::vector<Scaled>& factors) {
  cln::cl_RA coefficient = 1;
  std::vector<Factor> collected;
  for (const Scaled& factor : factors) multiply_in(factor, 1, coefficient, collected);
  return assemble(coefficient, std::move(collected));
}

Scaled Dag::power(const Scaled& base, const cln::cl_RA& exponent) {
  cln::cl_RA coefficient = 1;
  std::vector<Factor> collected;
  multiply_in(base, exponent, coefficient, collected);
  return assemble(coefficient, std::move(collected));
}

void Dag::multiply_in(const Scaled& base, const cln::cl_RA& exponent, cln::cl_RA& coefficient,
                      std::vector<Factor>& factors) {
  if (exponent == 0) return;
  if (base.coefficient == 0) {
    if (cln::minusp(exponent)) throw ModelError("division by zero");
    coefficient = 0;
    return;
  }
  if (is_integer(exponent)) {
    coefficient = coefficient * cln::expt(base.coefficient, cln::numerator(exponent));
    for (const Factor& f : factors_of(base.node)) {
      factors.push_back({f.node, f.exponent * exponent});
    }
    return;
  }
  multiply_root(cln::abs(base.coefficient), exponent, coefficient, factors);
  if (cln::plusp(base.coefficient)) {
    if (base.node != kOne) factors.push_back({base.node, exponent});
    return;
  }
  if (base.node == kOne) {
    throw ModelError("a root of the negative number " + text(base) +
                     " appears: every expression must be real");
  }
  Node negated;  // the only sums that begin with a minus: radicands
  negated.kind = NodeKind::sum;
  negated.terms = {{-1, base.node}};
  if ((*this)[base.node].kind == NodeKind::sum) {
    negated.terms.clear();
    for (const Scaled& t : (*this)[base.node].terms) {
      negated.terms.push_back({-t.coefficient, t.node});
    }
  }
  factors.push_back({intern(std::move(negated)), exponent});
}

void Dag::multiply_root(const cln::cl_RA& base, const cln::cl_RA& exponent, cln::cl_RA& coefficient,
                        std::vector<Factor>& factors) {
  const auto multiply = [&](cln::cl_I integer, const cln::cl_RA& power) {
    const cln::cl_I whole = cln::floor1(power);
    const cln::cl_RA rest = power - whole;
    coefficient = coefficient * cln::expt(cln::cl_RA(integer), whole);
    cln::cl_I root;
    if (rest == 0 || integer == 1) return;
    const cln::cl_I outside = divide_out_powers(integer, cln::denominator(rest));
    coefficient = coefficient * cln::expt(cln::cl_RA(outside), cln::numerator(rest));
    if (integer == 1) return;
    if (cln::rootp(integer, cln::denominator(rest), &root)) {
      coefficient = coefficient * cln::expt(cln::cl_RA(root), cln::numerator(rest));
      return;
    }
    Node node;
    node.kind = NodeKind::number;
    node.number = integer;
    factors.push_back({intern(std::move(node)), rest});
  };
  multiply(cln::numerator(base), exponent);
  multiply(cln::denominator(base), -exponent);
}

bool Dag::is_radicand(NodeId id) const {
  const Node& node = (*this)[id];
  return node.kind == NodeKind::sum &&
         (node.terms.size() == 1 || cln::minusp(node.terms[0].coefficient));
}

/// sqrt(1 - x) * (x - 1) = -(1 - x)^(3/2): of the two, the radicand stays.
void Dag::join_radicands(cln::cl_RA& coefficient, std::map<NodeId, cln::cl_RA>& exponents) {
  std::vector<NodeId> radicands;
  for (const auto& [base, exponent] : exponents) {
    if (is_radicand(base) && !is_integer(exponent)) radicands.push_back(base);
  }
  for (const NodeId radicand : radicands) {
    const std::vector<Scaled> terms = (*this)[radicand].terms;
    const Scaled opposite = sum(terms);
    const auto found = exponents.find(opposite.node);
    if (opposite.coefficient != -1 || found == exponents.end() || !is_integer(found->second))
      continue;
    if (cln::oddp(cln::numerator(found->second))) coefficient = -coefficient;
    exponents.at(radicand) = exponents.at(radicand) + found->second;
    exponents.erase(found);
  }
}

Scaled Dag::assemble(cln::cl_RA coefficient, std::vector<Factor> factors) {
  if (coefficient == 0) return {0, kOne};
  std::map<NodeId, cln::cl_RA> exponents;
  for (const Factor& f : factors) {
    const auto [place, is_new] = exponents.try_emplace(f.node, f.exponent);
    if (!is_new) place->second = place->second + f.exponent;
  }
  join_radicands(coefficient, exponents);
  Node node;
  node.kind = NodeKind::product;
  for (const auto& [base, exponent] : exponents) {
    if (exponent == 0) continue;
    const Node& inner = (*this)[base];
    if (inner.kind == NodeKind::number) {  // 2^(1/2) * 2^(1/2) = 2
      std::vector<Factor> rest;
      multiply_root(inner.number, exponent, coefficient, rest);
      node.factors.insert(node.factors.end(), rest.begin(), rest.end());
      continue;
    }
    if (is_radicand(base) && is_integer(exponent)) {
      const std::vector<Scaled> terms = inner.terms;
      multiply_in(sum(terms), exponent, coefficient, node.factors);
      continue;
    }
    node.factors.push_back({base, exponent});
  }
  std::ranges::sort(node.factors, [this](const Factor& a, const Factor& b) {
    return compare_atoms(a.node, b.node) < 0;
  });
  if (node.factors.empty()) return {coefficient, kOne};
  if (node.factors.size() == 1 && node.factors[0].exponent == 1) {
    return {coefficient, node.factors[0].node};
  }
  return {coefficient, intern(std::move(node))};
}

Scaled Dag::call(Op function, std::vector<Scaled> arguments) {
  cln::cl_RA sign = 1;
  const Parity parity = function_row(function).parity;
  if (parity != Parity::none && cln::minusp(arguments[0].coefficient)) {
    arguments[0].coefficient = -arguments[0].coefficient;
    if (parity == Parity::odd) sign = -1;
  }
  Node node;
  node.kind = NodeKind::function;
  node.function = function;
  node.terms = std::move(arguments);
  return {sign, intern(std::move(node))};
}

NodeId Dag::intern(Node node) {
  std::vector<NodeId>& bucket = index_[hash_of(node)];
  for (const NodeId id : bucket) {
    if (same((*this)[id], node)) return id;
  }
  node.constant = node.kind != NodeKind::symbol;
  if (node.kind == NodeKind::symbol) {
    node.degree = degrees_[static_cast<std::size_t>(node.symbol)];
  }
  for (std::size_t i = 0; i < node.terms.size(); ++i) {
    const Node& inner = (*this)[node.terms[i].node];
    node.constant = node.constant && inner.constant;
    if (node.kind == NodeKind::sum && (i == 0 || inner.degree > node.degree)) {
      node.degree = inner.degree;
    }
  }
  for (const Factor& f : node.factors) {
    node.constant = node.constant && (*this)[f.node].constant;
    node.degree = node.degree + (*this)[f.node].degree * f.exponent;
  }
  nodes_.push_back(std::move(node));
  bucket.push_back(static_cast<NodeId>(nodes_.size()) - 1);
  return bucket.back();
}

}  // namespace casimir::codegen
