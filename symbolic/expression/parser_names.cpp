// Expressions: names, and what is called with arguments.
#include "symbolic/expression/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/expression/arbitrary_call.hpp"
#include "symbolic/expression/notation.hpp"
#include "symbolic/expression/principal_values.hpp"
#include "symbolic/expression/spelling.hpp"

namespace casimir {

using GiNaC::ex;

Quantity Parser::name() {
  const std::size_t start = at_;
  std::string word = read_name(text_.value, at_, end_);
  if (const std::optional<long> index = value_of_index(word, start)) return known_integer(*index);
  if (names_.find(word) == nullptr) word = usual_name(word);
  if (peek() == '[' && find_elementary_function(word) == nullptr) word = member_of(word);
  if (const ElementaryFunction* function = find_elementary_function(word))
    return call(*function, start);
  if (peek() == '(' && names_.find(word) == nullptr) {
    if (word == "diff") return partial_derivative(start);
    if (word == "rate") return rate(start);
    if (word == "sum" || word == "product") return repeated(word == "sum", start);
    if (word == "mod") return remainder(start);
    if (word == "dot") return scalar_product(start);
    if (word == "cross") return vector_product(start);
    if (word == "trace") return trace(start);
    if (word == "det") return determinant(start);
    if (word == "matrix") return entry(start);
    if (const EllipticFunction* function = find_elliptic_function(word))
      return call(*function, start);
    if (find_with_subscript(word, names_) == nullptr)
      fail_at(start, fmt::format("unknown function '{}'", printable(word)),
              hint_for_function(word));
  }
  if (word == "Pi") return {GiNaC::Pi, 1, 0, 1};
  if (word == "I") {
    imaginary_unit_ = true;
    return {GiNaC::I, 1, 0, 1};
  }
  const Quantity* known = names_.find(word);
  if (known == nullptr) known = find_with_subscript(word, names_);
  if (known == nullptr && component_) return component_of(word, start);
  if (known == nullptr) undeclared(word, start);
  if (const auto function = named_function(known->value))
    return arbitrary_call(known->value, *function, start);
  add_parts_of(*known);
  return *known;
}

Quantity Parser::arbitrary_call(const ex& symbol, const FunctionName& function, std::size_t start) {
  peek();
  const std::vector<unsigned> orders = read_orders(text_, at_, end_, function);
  const Quantity q =
      value_of_arbitrary(symbol, orders, arguments(function.name, orders.size(), start));
  add_part(q.value);
  return checked(q, start);
}

void Parser::undeclared(const std::string& word, std::size_t start) {
  fail_at(start, fmt::format("'{}' is not declared", printable(word)),
          hint_for_name(word, names_.known()));
}

std::vector<Quantity> Parser::arguments(std::string_view function, std::size_t arity,
                                        std::size_t start) {
  if (arity == 1 && peek() == '{') return {braced()};
  if (!accept('('))
    fail_at(start, fmt::format("'{}' is a function and needs '('", function),
            fmt::format("as in {}(x), powers behind: {}(x)^2", function, function));
  std::vector<Quantity> given;
  if (peek() != ')') {
    do {
      const std::size_t offset = at_;
      given.push_back(number_of(offset, sum()));
    } while (accept(','));
  }
  if (!accept(')')) unexpected("',' or ')'");
  if (given.size() != arity) {
    fail_at(start, fmt::format("'{}' takes {} argument{}, {} given", function, arity,
                               arity == 1 ? "" : "s", given.size()));
  }
  return given;
}

Quantity Parser::bracket() {
  const std::size_t start = at_++;
  const Quantity f = number_of(start, sum());
  if (!accept(',')) unexpected("',' of a bracket {F, G}");
  const Quantity g = number_of(start, sum());
  if (!accept('}')) unexpected("'}'");
  const Dynamics* dynamics = names_.dynamics();
  if (dynamics == nullptr || !dynamics->has_bracket())
    fail_at(start, "there is no Poisson bracket here");
  const auto n = static_cast<double>(dynamics->dimension());
  Quantity q{0, f.bits + g.bits, f.degree + g.degree,
             n * n * (derivative_nodes(f) + derivative_nodes(g)),
             3 + 2 * std::max(f.depth, g.depth)};
  checked(q, start);
  q.value = evaluated(start, [&] { return dynamics->bracket(f.value, g.value); });
  add_parts_of(with_parts(q, dynamics->parts_of_bracket()));
  return q;
}

Quantity Parser::rate(std::size_t start) {
  const Quantity f = arguments("rate", 1, start).front();
  const Dynamics* dynamics = names_.dynamics();
  if (dynamics == nullptr || !dynamics->has_flow())
    fail_at(start, "the equations of motion are not known here");
  const auto n = static_cast<double>(dynamics->dimension());
  Quantity q{0, f.bits * 2, f.degree * 2, n * n * derivative_nodes(f), 3 + 2 * f.depth};
  checked(q, start);
  q.value = evaluated(start, [&] { return dynamics->rate(f.value); });
  add_parts_of(with_parts(q, dynamics->parts_of_flow()));
  return q;
}

Quantity Parser::partial_derivative(std::size_t start) {
  const std::vector<Quantity> given = arguments("diff", 2, start);
  if (!GiNaC::is_a<GiNaC::symbol>(given[1].value))
    fail_at(start, "the second argument of 'diff' must be a variable or a parameter");
  Quantity q = given[0];
  q.nodes = derivative_nodes(given[0]);
  q.depth = 1 + 2 * q.depth;
  checked(q, start);
  q.value = evaluated(
      start, [&] { return given[0].value.diff(GiNaC::ex_to<GiNaC::symbol>(given[1].value)); });
  return q;
}

Quantity Parser::call(const ElementaryFunction& function, std::size_t start) {
  const std::vector<Quantity> arguments = this->arguments(function.name, function.arity, start);
  const Quantity& first = arguments.front();
  const Quantity& last = arguments.back();
  if (function.real && complex_numbers())
    fail_at(start, fmt::format("'{}' is for real numbers, and there is I here or in the case",
                               function.name));
  const double uses = function.uses;
  Quantity q{0, uses * first.bits, uses * first.degree, uses * (1 + first.nodes),
             (uses > 1 ? 3 : 1) + std::max(first.depth, last.depth)};
  if (arguments.size() > 1) {
    q.bits += last.bits;
    q.degree += last.degree;
    q.nodes += last.nodes;
  }
  q.degree = std::max(1.0, q.degree);
  checked(q, start);
  // GiNaC says 0, but no direction leads to the origin.
  if (function.name == "atan2" && first.value.is_zero() && last.value.is_zero())
    fail_at(start, "this has no value: atan2(0, 0)");
  q.value = real_value(evaluated(start,
                                 [&] {
                                   return function.name == "sqrt"
                                              ? principal_power(first.value, GiNaC::numeric(1, 2),
                                                                complex_numbers())
                                              : function.apply(first.value, last.value);
                                 }),
                       start);
  if (!function.everywhere) add_part(q.value);
  return checked(q, start);
}

Quantity Parser::call(const EllipticFunction& function, std::size_t start) {
  const std::vector<Quantity> given = arguments(function.name, function.arity, start);
  if (complex_numbers())
    fail_at(start, fmt::format("'{}' is for real numbers, and there is I here or in the case",
                               function.name));
  Quantity q{0, 0, 1, 1, 1};
  GiNaC::exvector values;
  for (const Quantity& argument : given) {
    q.bits += argument.bits;
    q.degree += argument.degree;
    q.nodes += argument.nodes;
    q.depth = std::max(q.depth, 1 + argument.depth);
    values.push_back(argument.value);
  }
  checked(q, start);
  q.value = evaluated(start, [&] { return function.apply(values); });
  add_part(q.value);
  return checked(q, start);
}

}  // namespace casimir
