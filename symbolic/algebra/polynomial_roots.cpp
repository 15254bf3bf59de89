#include "symbolic/algebra/polynomial_roots.hpp"

#include <acb.h>
#include <arb_fmpz_poly.h>

#include <algorithm>

#include "symbolic/algebra/flint_conversion.hpp"

namespace casimir::search {

std::vector<std::pair<double, double>> complex_roots(const std::vector<cln::cl_I>& coefficients) {
  constexpr slong kBits = 64;
  fmpz_poly_t polynomial;
  fmpz_poly_init(polynomial);
  fmpz_t number;
  fmpz_init(number);
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    to_fmpz(number, coefficients[k]);
    fmpz_poly_set_coeff_fmpz(polynomial, static_cast<slong>(k), number);
  }
  const auto degree = static_cast<slong>(coefficients.size()) - 1;
  acb_ptr const roots = _acb_vec_init(degree);
  arb_fmpz_poly_complex_roots(roots, polynomial, 0, kBits);
  std::vector<std::pair<double, double>> result;
  for (slong k = 0; k < degree; ++k) {
    const auto middle = [](arb_srcptr ball) { return arf_get_d(arb_midref(ball), ARF_RND_NEAR); };
    result.emplace_back(middle(acb_realref(roots + k)), middle(acb_imagref(roots + k)));
  }
  _acb_vec_clear(roots, degree);
  fmpz_clear(number);
  fmpz_poly_clear(polynomial);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace casimir::search
