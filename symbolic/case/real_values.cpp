#include "symbolic/case/real_values.hpp"

#include <string>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/elliptic.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// With zero.
Assumption compared(const ex& difference, Comparison comparison) {
  return {difference, comparison, expression_text(difference) + ' ' + to_string(comparison) + " 0"};
}

void add_of_power(const ex& base, const ex& exponent, bool complex,
                  std::vector<Assumption>& conditions) {
  if (!GiNaC::is_a<GiNaC::numeric>(exponent)) {
    conditions.push_back(compared(base, complex ? Comparison::unequal : Comparison::greater));
    return;
  }
  const GiNaC::numeric& number = GiNaC::ex_to<GiNaC::numeric>(exponent);
  if (!number.is_integer() && !complex) conditions.push_back(compared(base, Comparison::at_least));
  if (!number.is_positive()) conditions.push_back(compared(base, Comparison::unequal));
}

void add_of_function(const GiNaC::function& f, bool complex, std::vector<Assumption>& conditions) {
  const std::string name = f.get_name();
  const ex u = f.op(0);
  if (is_elliptic_function(f)) {
    // A modulus between -1 and 1, and positive arguments of Carlson's integrals.
    if (name[0] != 'R') conditions.push_back(compared(1 - f.op(1) * f.op(1), Comparison::greater));
    for (std::size_t i = 0; name[0] == 'R' && i < f.nops(); ++i)
      conditions.push_back(compared(f.op(i), Comparison::greater));
    return;
  }
  if (name == "log") {
    conditions.push_back(compared(u, complex ? Comparison::unequal : Comparison::greater));
  } else if (name == "tan") {
    conditions.push_back(compared(GiNaC::cos(u), Comparison::unequal));
  } else if (name == "asin" || name == "acos") {
    if (!complex) conditions.push_back(compared(1 - u * u, Comparison::at_least));
  } else if (name == "atan2") {
    conditions.push_back(compared(u * u + f.op(1) * f.op(1), Comparison::unequal));
  }
}

}  // namespace

std::vector<Assumption> conditions_for_values(const ex& expression, bool complex) {
  std::vector<Assumption> conditions;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
    if (GiNaC::is_a<GiNaC::power>(*part))
      add_of_power(part->op(0), part->op(1), complex, conditions);
    else if (GiNaC::is_a<GiNaC::function>(*part))
      add_of_function(GiNaC::ex_to<GiNaC::function>(*part), complex, conditions);
  }
  return conditions;
}

std::optional<ex> real_only_where(const Assumption& condition) {
  const Comparison comparison = condition.comparison;
  const bool below = comparison == Comparison::less || comparison == Comparison::at_most;
  const bool strict = comparison == Comparison::less || comparison == Comparison::greater;
  const ex difference = below ? -condition.difference : condition.difference;
  if (comparison == Comparison::equal || GiNaC::is_a<GiNaC::numeric>(difference))
    return std::nullopt;
  return comparison == Comparison::unequal ? 1 / difference
         : strict                          ? GiNaC::log(difference)
                                           : GiNaC::sqrt(difference);
}

}  // namespace casimir
