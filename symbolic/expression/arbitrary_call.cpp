#include "symbolic/expression/arbitrary_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace casimir {
namespace {

constexpr unsigned kMostDerivatives = 9;

std::size_t spaces(const Text& text, std::size_t at, std::size_t end) {
  while (at < end && std::isspace(static_cast<unsigned char>(text.value[at])) != 0) ++at;
  return at;
}

/// The numbers in brackets, from 1 on; `at` is behind the first bracket.
void read_indices(const Text& text, std::size_t& at, std::size_t end, const std::string& hint,
                  std::vector<unsigned>& orders) {
  for (;;) {
    at = spaces(text, at, end);
    const std::size_t begin = at;
    std::size_t index = 0;
    for (; at < end && std::isdigit(static_cast<unsigned char>(text.value[at])) != 0; ++at)
      index = std::min<std::size_t>(kMostArguments + 1,
                                    10 * index + static_cast<std::size_t>(text.value[at] - '0'));
    if (index < 1 || index > orders.size())
      throw text.error("there is no such argument", begin, hint);
    if (++orders[index - 1] > kMostDerivatives)
      throw text.error(fmt::format("more than {} derivatives", kMostDerivatives), begin);
    at = spaces(text, at, end);
    const char c = at < end ? text.value[at] : '\0';
    if (c != ',' && c != ']') throw text.error("expected ',' or ']'", at, hint);
    ++at;
    if (c == ']') return;
  }
}

}  // namespace

std::vector<unsigned> read_orders(const Text& text, std::size_t& at, std::size_t end,
                                  const FunctionName& function) {
  std::vector<unsigned> orders(function.arguments.size(), 0);
  const std::size_t begin = at;
  unsigned primes = 0;
  for (; at < end && text.value[at] == '\''; at = spaces(text, at + 1, end))
    if (++primes > kMostDerivatives)
      throw text.error(fmt::format("more than {} derivatives", kMostDerivatives), begin);
  if (orders.size() == 1) {
    orders[0] = primes;
    return orders;
  }
  if (primes == 0) return orders;
  const std::string hint = fmt::format(
      "'{0}' has {1} arguments: {0}'[1](..) is its derivative by the first, "
      "{0}'[1,2](..) by the first and the second",
      function.name, orders.size());
  if (primes > 1 || at >= end || text.value[at] != '[')
    throw text.error(fmt::format("'{}' is differentiated by which argument?", function.name), begin,
                     hint);
  ++at;
  read_indices(text, at, end, hint, orders);
  return orders;
}

std::optional<FunctionName> named_function(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::symbol>(value)) return std::nullopt;
  return function_name(GiNaC::ex_to<GiNaC::symbol>(value).get_name());
}

Quantity value_of_arbitrary(const GiNaC::ex& function, const std::vector<unsigned>& orders,
                            const std::vector<Quantity>& arguments) {
  Quantity q{0, 1, 0, 1, 1};
  std::vector<GiNaC::ex> values;
  for (const Quantity& argument : arguments) {
    q.bits += argument.bits;
    q.degree += argument.degree;
    q.nodes += argument.nodes;
    q.depth = std::max(q.depth, 1 + argument.depth);
    values.push_back(argument.value);
  }
  q.degree = std::max(1.0, q.degree);
  q.value = arbitrary(function, orders, values);
  return q;
}

}  // namespace casimir
