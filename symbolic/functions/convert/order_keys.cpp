#include "symbolic/functions/convert/order_keys.hpp"

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/pairs.hpp"

namespace casimir::functions {

using GiNaC::ex;

namespace {

std::string text_of(const GiNaC::numeric& number) {
  if (number.is_integer() && GiNaC::abs(number) < 1000) return std::to_string(number.to_int());
  return expression_text(number);
}

}  // namespace

/// Text that orders expressions, the same in every process.
const std::string& OrderKeys::key(const ex& e) {
  const auto known = keys_.find(e);
  if (known != keys_.end()) return known->second;
  std::string text;
  if (GiNaC::is_exactly_a<GiNaC::symbol>(e)) {
    text = GiNaC::ex_to<GiNaC::symbol>(e).get_name();
  } else if (e.nops() == 0) {
    text = GiNaC::is_exactly_a<GiNaC::numeric>(e) ? text_of(GiNaC::ex_to<GiNaC::numeric>(e))
                                                  : expression_text(e);
  } else if (GiNaC::is_exactly_a<GiNaC::add>(e)) {
    text = key_of_sum(e);
  } else {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < e.nops(); ++i) parts.push_back(key(e.op(i)));
    if (GiNaC::is_a<GiNaC::mul>(e)) std::sort(parts.begin(), parts.end());
    text = GiNaC::is_a<GiNaC::mul>(e)        ? "*"
           : GiNaC::is_a<GiNaC::function>(e) ? GiNaC::ex_to<GiNaC::function>(e).get_name()
                                             : "^";
    for (const std::string& part : parts) text += "(" + part + ")";
  }
  return keys_.emplace(e, std::move(text)).first->second;
}

/// Up to the sign of the whole: GiNaC makes (a - b)^2 of (b - a)^2 or the other way round, by the
/// addresses of a and b.
std::string OrderKeys::key_of_sum(const ex& e) {
  std::vector<std::pair<std::string, GiNaC::numeric>> parts;
  for (const GiNaC::expair& pair : Pairs::of(e))
    parts.emplace_back(key(pair.rest), GiNaC::ex_to<GiNaC::numeric>(pair.coeff));
  parts.emplace_back("", GiNaC::ex_to<GiNaC::numeric>(Pairs::number(e)));
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  int sign = 0;
  std::string result = "+";
  for (const auto& [key, coefficient] : parts) {
    if (sign == 0) sign = coefficient.csgn();
    result += "(" + text_of(sign < 0 ? -coefficient : coefficient) + "*" + key + ")";
  }
  return result;
}

void OrderKeys::sort(GiNaC::exvector& operands) {
  if (operands.size() < 2) return;
  std::sort(operands.begin(), operands.end(),
            [this](const ex& a, const ex& b) { return key(a) < key(b); });
}

}  // namespace casimir::functions
