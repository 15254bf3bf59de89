#include "symbolic/expression/expression.hpp"

#include <fmt/format.h>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression_range.hpp"
#include "symbolic/expression/parser.hpp"

namespace casimir {

Quantity parse_range(const Text& text, Scope& names, std::size_t begin, std::size_t end) {
  const Limits& limits = names.limits();
  if (static_cast<double>(text.value.size()) > limits.file_bytes) {
    throw text.beyond(limits, &Limits::file_bytes,
                      fmt::format("the expression has {} bytes; the limit is {:.0f}",
                                  text.value.size(), limits.file_bytes));
  }
  return Parser(text, names, begin, end).parse();
}

Quantity parse_expression(const Text& text, Scope& names) {
  return parse_range(text, names, 0, text.value.size());
}

}  // namespace casimir
