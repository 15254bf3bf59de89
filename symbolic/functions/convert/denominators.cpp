#include "symbolic/functions/convert/denominators.hpp"

#include <cln/rational.h>

#include <optional>
#include <utility>

namespace casimir::functions {

namespace {

constexpr const char* kDivisionByZero = "division by an expression that is identically zero";

/// Empty where p is identically zero.
std::optional<Polynomial> inverse_if_any(GeneratorTable& table, const Polynomial& p) {
  const auto [unreduced, bottom] = table.fraction(p);
  const Polynomial reduced_top = table.numerator(unreduced);
  if (reduced_top.is_zero()) return std::nullopt;
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

}  // namespace

Polynomial inverse_of(GeneratorTable& table, const Polynomial& p) {
  if (std::optional<Polynomial> inverse = inverse_if_any(table, p)) return *std::move(inverse);
  throw ModelError(kDivisionByZero);
}

Polynomial divided_by(GeneratorTable& table, const Polynomial& p) {
  if (std::optional<Polynomial> inverse = inverse_if_any(table, p)) return *std::move(inverse);
  throw NoValue(kDivisionByZero);
}

}  // namespace casimir::functions
