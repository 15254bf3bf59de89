#include "symbolic/discrete/univariate.hpp"

#include <flint/nmod_poly_factor.h>

namespace casimir::discrete {

std::vector<Element> Univariate::zeros() const {
  const PrimeField field(value_->mod.n);
  nmod_poly_factor_t factors;
  nmod_poly_factor_init(factors);
  nmod_poly_roots(factors, value_, 0);
  std::vector<Element> result;
  for (slong i = 0; i < factors->num; ++i) {
    const nmod_poly_struct& line = factors->p[i];
    const Element root = field.multiply(nmod_poly_get_coeff_ui(&line, 0),
                                        field.inverse(nmod_poly_get_coeff_ui(&line, 1)));
    result.push_back(field.subtract(0, root));
  }
  nmod_poly_factor_clear(factors);
  return result;
}

std::optional<Quotient> quotient_from_values(const std::vector<Element>& t,
                                             const std::vector<Element>& y, Element prime) {
  constexpr long kSure = 6;
  const auto count = static_cast<long>(t.size());
  const Univariate zero(prime);
  Univariate r0 = zero, r1 = zero, s0 = zero, s1 = zero, quotient = zero, rest = zero,
             product = zero;
  nmod_poly_product_roots_nmod_vec(r0.raw(), t.data(), count);
  nmod_poly_interpolate_nmod_vec(r1.raw(), t.data(), y.data(), count);
  nmod_poly_one(s1.raw());
  long largest = 0;
  std::optional<Quotient> best;
  if (r1.is_zero()) best = Quotient{r1, s1};  // all values are 0
  while (!r1.is_zero()) {
    nmod_poly_divrem(quotient.raw(), rest.raw(), r0.raw(), r1.raw());
    if (quotient.degree() > largest) {
      largest = quotient.degree();
      best = Quotient{r1, s1};
    }
    nmod_poly_mul(product.raw(), quotient.raw(), s1.raw());
    nmod_poly_sub(product.raw(), s0.raw(), product.raw());
    nmod_poly_swap(s0.raw(), s1.raw());
    nmod_poly_swap(s1.raw(), product.raw());
    nmod_poly_swap(r0.raw(), r1.raw());
    nmod_poly_swap(r1.raw(), rest.raw());
  }
  if (best && !best->top.is_zero() && largest < kSure) return std::nullopt;
  return best;
}

}  // namespace casimir::discrete
