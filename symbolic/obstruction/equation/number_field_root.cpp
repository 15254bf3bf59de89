// Square roots in number fields, by factoring over the rational numbers alone.
#include <flint/fmpq_mat.h>

#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {
namespace {

/// The characteristic polynomial of the multiplication by a number of the field Q[z]/f.
Univariate characteristic_polynomial(const Univariate& value, const Univariate& f) {
  const long n = f.degree();
  fmpq_mat_t matrix;
  fmpq_mat_init(matrix, n, n);
  Univariate column = value.remainder(f);
  for (long j = 0; j < n; ++j) {
    for (long i = 0; i < n; ++i)
      fmpq_poly_get_coeff_fmpq(fmpq_mat_entry(matrix, i, j), column.raw(), i);
    column = (column * Univariate::variable()).remainder(f);
  }
  Univariate result;
  fmpq_mat_charpoly(result.raw(), matrix);
  fmpq_mat_clear(matrix);
  return result;
}

/// The root of x^2 = value in the field where it is one of M(x) = 0: M = E(x^2) + x O(x^2).
Univariate root_of(const Univariate& m, const Univariate& value, const Univariate& f) {
  std::vector<cln::cl_RA> even, odd;
  for (long i = 0; i <= m.degree(); ++i) (i % 2 == 0 ? even : odd).push_back(m.coefficient(i));
  const Univariate above = Univariate(even).composed(value).remainder(f);
  const Univariate below = Univariate(odd).composed(value).remainder(f);
  return (-above * below.inverse(f)).remainder(f);
}

}  // namespace

std::optional<Univariate> square_root(const Univariate& value, const Univariate& f) {
  const Univariate own = value.remainder(f);
  if (own.is_zero()) return Univariate();
  if (f.degree() == 1) {
    const std::optional<cln::cl_RA> root = square_root(own.coefficient(0));
    return root ? std::optional<Univariate>(*root) : std::nullopt;
  }
  // Finitely many q fail: those for which two conjugates of value*q^2 are equal.
  for (int shift = 0;; ++shift) {
    const Univariate q = Univariate::variable() + Univariate(shift);
    const Univariate moved = (own * q * q).remainder(f);
    const Univariate c = characteristic_polynomial(moved, f);
    if (gcd(c, c.derivative()).degree() > 0) continue;
    const auto factors = c.composed(Univariate::variable().pow(2)).factors();
    if (factors.size() == 1) return std::nullopt;
    const Univariate root = root_of(factors.front().first, moved, f) * q.inverse(f);
    const Univariate result = root.remainder(f);
    if (!((result * result).remainder(f) == own))
      throw std::logic_error("a square root in a number field is none");
    return result;
  }
}

}  // namespace casimir::obstruction
