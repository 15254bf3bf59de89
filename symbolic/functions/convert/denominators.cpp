#include "symbolic/functions/convert/denominators.hpp"

#include <cln/rational.h>

namespace casimir::functions {

Polynomial inverse_of(GeneratorTable& table, const Polynomial& p) {
  const auto [unreduced, bottom] = table.fraction(p);
  const Polynomial reduced_top = table.numerator(unreduced);
  if (reduced_top.is_zero()) throw ModelError("division by an expression that is identically zero");
  // sin^2 + cos^2 is 1, but cos^2 as it stands says more than (1 - sin)(1 + sin).
  const Polynomial& top = reduced_top.terms() < unreduced.terms() ? reduced_top : unreduced;
  Polynomial result = bottom;
  for (const auto& [factor, exponent] : top.factors()) {
    if (factor.is_constant()) {
      result = result.scaled(1 / factor.term_list()[0].first);
      continue;
    }
    std::size_t index = 0;
    Polynomial y(table.ring());
    if (table.find(Kind::inverse, factor, 1, &index) != nullptr) {
      y = table.variable(index);
    } else {
      const Polynomial next = table.next_variable();
      y = table.generator(Kind::inverse, 1 / table.expression(factor), factor, 1,
                          [&](const Polynomial& slope) { return -(slope * next * next); });
    }
    result = table.checked_product(result, table.power(y, exponent));
  }
  return result;
}

}  // namespace casimir::functions
