#include "symbolic/expression/arbitrary.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_set>

#include "symbolic/expression/name_characters.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using GiNaC::exvector;

/// Operands: the function, one order for each argument, the arguments.
std::size_t count_of(std::size_t operands) { return (operands - 1) / 2; }

unsigned order_of(const ex& operand) {
  return static_cast<unsigned>(GiNaC::ex_to<GiNaC::numeric>(operand).to_int());
}

unsigned serial_of(std::size_t count);

ex evaluated(const exvector& operands) {
  const std::size_t count = count_of(operands.size());
  const ex& function = operands[0];
  if (!GiNaC::is_a<GiNaC::lst>(function) || function.nops() != count + 1)
    return GiNaC::function(serial_of(count), operands).hold();
  ex value = function.op(count);
  GiNaC::exmap at;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& formal = GiNaC::ex_to<GiNaC::symbol>(function.op(i));
    value = value.diff(formal, order_of(operands[1 + i]));
    at[formal] = operands[1 + count + i];
  }
  return value.subs(at, GiNaC::subs_options::no_pattern);
}

ex differentiated(const exvector& operands, unsigned place) {
  const std::size_t count = count_of(operands.size());
  if (place < 1 + count) return 0;  // neither the function nor the orders depend on anything
  exvector next = operands;
  next[place - count] += 1;
  return GiNaC::function(serial_of(count), next);
}

void print_value(const exvector& operands, const GiNaC::print_context& context) {
  const std::size_t count = count_of(operands.size());
  std::vector<unsigned> orders;
  for (std::size_t i = 0; i < count; ++i) orders.push_back(order_of(operands[1 + i]));
  std::string name = "function";
  if (GiNaC::is_a<GiNaC::symbol>(operands[0])) {
    name = GiNaC::ex_to<GiNaC::symbol>(operands[0]).get_name();
    if (const auto known = function_name(name)) name = known->name;
  }
  context.s << derivative_text(name, orders) << '(';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) context.s << ",";
    operands[1 + count + i].print(context);
  }
  context.s << ')';
}

/// GiNaC's number of the function that has so many arguments.
unsigned serial_of(std::size_t count) {
  static const std::array<unsigned, kMostArguments> serials = [] {
    std::array<unsigned, kMostArguments> result{};
    for (std::size_t k = 1; k <= kMostArguments; ++k) {
      GiNaC::function_options options("arbitrary" + std::to_string(k),
                                      static_cast<unsigned>(1 + 2 * k));
      options.eval_func(GiNaC::eval_funcp_exvector(evaluated));
      options.derivative_func(GiNaC::derivative_funcp_exvector(differentiated));
      options.print_func<GiNaC::print_context>(GiNaC::print_funcp_exvector(print_value));
      result[k - 1] = GiNaC::function::register_new(options);
    }
    return result;
  }();
  return serials.at(count - 1);
}

}  // namespace

std::string function_parameter_name(const FunctionName& function) {
  std::string result = function.name + "(";
  for (std::size_t i = 0; i < function.arguments.size(); ++i)
    result += (i > 0 ? ", " : "") + function.arguments[i];
  return result + ")";
}

std::optional<FunctionName> function_name(const std::string& parameter) {
  const std::size_t open = parameter.find('(');
  if (open == std::string::npos || parameter.back() != ')') return std::nullopt;
  FunctionName result{parameter.substr(0, open), {}};
  std::string argument;
  for (std::size_t i = open + 1; i < parameter.size(); ++i) {
    if (is_name_part(parameter[i])) {
      argument += parameter[i];
    } else if (!argument.empty()) {
      result.arguments.push_back(std::move(argument));
      argument.clear();
    }
  }
  return result;
}

ex arbitrary(const ex& function, const std::vector<unsigned>& orders,
             const std::vector<ex>& arguments) {
  exvector operands{function};
  for (const unsigned order : orders) operands.emplace_back(order);
  operands.insert(operands.end(), arguments.begin(), arguments.end());
  return GiNaC::function(serial_of(arguments.size()), operands);
}

std::optional<Arbitrary> as_arbitrary(const GiNaC::function& f) {
  const std::size_t operands = f.nops();
  if (operands < 3 || operands % 2 == 0 || count_of(operands) > kMostArguments) return std::nullopt;
  const std::size_t count = count_of(operands);
  if (f.get_serial() != serial_of(count) || !GiNaC::is_a<GiNaC::symbol>(f.op(0)))
    return std::nullopt;
  Arbitrary result{GiNaC::ex_to<GiNaC::symbol>(f.op(0)), {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    result.orders.push_back(order_of(f.op(1 + i)));
    result.arguments.push_back(f.op(1 + count + i));
  }
  return result;
}

namespace {

void look_for_derivatives(const ex& e, std::unordered_set<ex>& seen,
                          std::optional<unsigned>& highest) {
  if (e.nops() == 0 || !seen.insert(e).second) return;
  if (GiNaC::is_exactly_a<GiNaC::function>(e)) {
    if (const auto f = as_arbitrary(GiNaC::ex_to<GiNaC::function>(e)))
      highest =
          std::max(highest.value_or(0), std::accumulate(f->orders.begin(), f->orders.end(), 0U));
  }
  for (std::size_t i = 0; i < e.nops(); ++i) look_for_derivatives(e.op(i), seen, highest);
}

}  // namespace

std::optional<unsigned> highest_derivative(const ex& expression) {
  std::optional<unsigned> highest;
  std::unordered_set<ex> seen;
  look_for_derivatives(expression, seen, highest);
  return highest;
}

ex given_function(const std::vector<GiNaC::symbol>& arguments, const ex& body) {
  GiNaC::lst result;
  for (const GiNaC::symbol& argument : arguments) result.append(argument);
  result.append(body);
  return result;
}

std::string derivative_text(const std::string& name, const std::vector<unsigned>& orders) {
  if (orders.size() == 1) return name + std::string(orders[0], '\'');
  std::string indices;
  for (std::size_t i = 0; i < orders.size(); ++i)
    for (unsigned k = 0; k < orders[i]; ++k)
      indices += (indices.empty() ? "" : ",") + std::to_string(i + 1);
  return indices.empty() ? name : name + "'[" + indices + "]";
}

}  // namespace casimir
