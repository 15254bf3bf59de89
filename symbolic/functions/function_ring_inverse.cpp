// Denominators in a FunctionRing.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {

/// The generators 1/f of the irreducible factors f of a denominator.
Polynomial FunctionRing::inverse(const Polynomial& p) {
  const auto [unreduced, bottom] = fraction(p);
  const Polynomial reduced_top = numerator(unreduced);
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
    Polynomial y(*ring_);
    if (find(Kind::inverse, factor, 1, &index) != nullptr) {
      y = ring_->variable(symbols_.size() + index);
    } else {
      const Polynomial next =
          ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
      y = generator(Kind::inverse, 1 / expression(factor), factor, 1,
                    [&](const Polynomial& slope) { return -(slope * next * next); });
    }
    result = checked_product(result, power(y, exponent));
  }
  return result;
}

}  // namespace casimir
