// Two expressions with a sign between them: conditions and equations.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_range.hpp"

namespace casimir {

using GiNaC::ex;

Condition parse_condition(const Text& text, Scope& names) {
  const std::string& s = text.value;
  const std::size_t at = s.find_first_of("!=<>");
  if (at == std::string::npos) {
    throw text.error("expected a condition such as 'r != 0' or 'G > 0'");
  }
  const bool two = at + 1 < s.size() && s[at + 1] == '=';
  const auto comparison = comparison_of(s.substr(at, two ? 2 : 1));
  if (!comparison) throw text.error("unexpected '!', expected '!='", at);
  const Quantity left = parse_range(text, names, 0, at);
  const Quantity right = parse_range(text, names, at + (two ? 2 : 1), s.size());
  std::vector<ex> parts;
  for (const Quantity* side : {&left, &right})
    if (side->parts) parts.insert(parts.end(), side->parts->begin(), side->parts->end());
  Quantity difference{left.value - right.value};
  difference.parts = std::make_shared<const std::vector<ex>>(std::move(parts));
  return {left.value, *comparison, right.value, lost_parts(difference)};
}

std::pair<Quantity, Quantity> parse_equation(const Text& text, Scope& names) {
  const std::size_t at = text.value.find('=');
  if (at == std::string::npos) return {parse_expression(text, names), {0}};
  return {parse_range(text, names, 0, at), parse_range(text, names, at + 1, text.value.size())};
}

}  // namespace casimir
