#include "symbolic/case/case_parts.hpp"

#include <fmt/format.h>

#include "symbolic/case/toml_keys.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/model/phase_space.hpp"

namespace casimir {

using GiNaC::ex;

int sign_of(const std::optional<Text>& text) {
  if (!text || text->value == "+") return 1;
  if (text->value == "-") return -1;
  throw text->error("'sign' must be \"+\" or \"-\"");
}

void check_symbol_name(const Text& name) {
  if (name.value == "value")
    throw name.error("'value' names the value of a residual in a witness, and cannot name this");
}

Assumption assumption_of(const Text& text, Scope& names, std::vector<ex>& lost) {
  const Condition condition = parse_condition(text, names);
  lost.insert(lost.end(), condition.lost.begin(), condition.lost.end());
  return {condition.left - condition.right, condition.comparison, text.value};
}

NamedExpression named(const Text& name, const Quantity& quantity) {
  return {name.value, quantity.value, name.where, lost_parts(quantity)};
}

NamedExpression anonymous(const Text& text, Scope& names) {
  return named(text, parse_expression(text, names));
}

std::vector<ex> all_components(const Text& map, const std::vector<Entry>& entries,
                               const std::vector<GiNaC::symbol>& symbols, Scope& names,
                               const std::string& what, std::vector<ex>& domain) {
  std::vector<ex> result(symbols.size());
  std::vector<bool> seen(symbols.size());
  for (const auto& [name, value] : entries) {
    const std::size_t i = symbol_position(name, name.value, 0, symbols, what);
    const Quantity quantity = parse_expression(value, names);
    for (const ex& part : lost_parts(quantity)) domain.push_back(part);
    result[i] = quantity.value;
    seen[i] = true;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i])
      throw map.error(fmt::format("the map gives no expression for '{}'", symbols[i].get_name()));
  }
  return result;
}

}  // namespace casimir
