// Rational solutions of the symmetric powers of y'' = r y.
#include <flint/fmpz_mat.h>
#include <flint/nmod_mat.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

constexpr long kLargestDegreeOfPower = 1500;
constexpr mp_limb_t kPrimeOfPowers = 4611686018427387847UL;  // the largest below 2^62

/// The orders that a combination of products of m solutions may have at a singular point, as a
/// series without logarithms and exponentials: sums of i times one exponent and m - i times the
/// other that are integers, at an irregular point only equally many of both. The exponents add up
/// to 1 (at infinity, as degrees, too); at an irregular point the product of both formal solutions
/// is r^(-1/2) to first order.
/// \return  the least order, or at infinity the largest degree; none if there is no integer
std::optional<long> extreme_order(const Singularity& s, long m) {
  std::vector<cln::cl_RA> orders;
  if (!s.regular()) {
    orders.push_back(cln::cl_RA(m * s.order) / 4);
  } else {
    const auto difference = s.rational_difference();
    for (long i = 0; i <= m; ++i)
      if (difference || 2 * i == m)
        orders.push_back((m + (2 * i - m) * difference.value_or(0)) / cln::cl_RA(2));
  }
  std::optional<long> result;
  for (const cln::cl_RA& order : orders) {
    if (cln::denominator(order) != 1) continue;
    const long value = cln::cl_I_to_long(cln::numerator(order));
    if (!result || (s.at_infinity() ? value > *result : value < *result)) result = value;
  }
  return result;
}

/// S = W P with W = product of f^v over the singular points f. The coefficients A_i of the form,
/// A_m = -S, A_(i-1) = -A_i' - (m-i)(i+1) r A_(i+1) (Kovacic 1986), are W C_i/G^(m-i) with
/// polynomials C_i, where G^2 r and G W'/W are polynomials; S is an invariant where A_(-1) = 0.
struct Recursion {
  long m;
  Univariate g, g_slope, g_logarithmic, g_squared_r;

  /// C_(-1) for a polynomial P.
  Univariate last(const Univariate& p) const {
    Univariate above, current = -p;
    for (long i = m; i >= 0; --i) {
      Univariate next = -(g * current.derivative() + g_logarithmic * current -
                          Univariate(cln::cl_RA(m - i)) * g_slope * current);
      next -= Univariate(cln::cl_RA((m - i) * (i + 1))) * g_squared_r * above;
      above = std::move(current);
      current = std::move(next);
    }
    return current;
  }
};

Recursion recursion(const RationalFunction& r, const std::vector<Singularity>& singular,
                    const std::vector<long>& orders, long m) {
  Univariate g(1);
  for (const Singularity& s : singular)
    if (!s.at_infinity()) g *= s.at.pow(static_cast<unsigned long>((s.order + 1) / 2));
  Univariate logarithmic;
  for (std::size_t i = 0; i < singular.size(); ++i)
    if (!singular[i].at_infinity())
      logarithmic += Univariate(cln::cl_RA(orders[i])) * singular[i].at.derivative() *
                     g.divided(singular[i].at).first;
  const RationalFunction squared = RationalFunction(g * g) * r;
  return {m, g, g.derivative(), logarithmic, squared.numerator()};
}

/// As data: of the steps of a proof.
std::vector<cln::cl_RA> coefficients_of(const Univariate& p) {
  std::vector<cln::cl_RA> result;
  for (long i = 0; i <= p.degree(); ++i) result.push_back(p.coefficient(i));
  return result;
}

/// A polynomial of degree `degree` at most that the recursion sends to zero.
std::optional<Univariate> kernel(const Recursion& map, long degree,
                                 const std::function<void()>& tick) {
  std::vector<Univariate> images;
  long height = 1;
  for (long j = 0; j <= degree; ++j) {
    tick();
    images.push_back(map.last(Univariate::variable().pow(static_cast<unsigned long>(j))));
    height = std::max(height, images.back().degree() + 1);
  }
  fmpz_mat_t matrix;
  fmpz_mat_init(matrix, height, degree + 1);
  // Columns times their denominators: the kernel is scaled back below.
  for (long j = 0; j <= degree; ++j) {
    const fmpq_poly_struct* image = images[static_cast<std::size_t>(j)].raw();
    for (long i = 0; i < fmpq_poly_length(image); ++i)
      fmpz_set(fmpz_mat_entry(matrix, i, j), image->coeffs + i);
  }
  nmod_mat_t modular;
  nmod_mat_init(modular, height, degree + 1, kPrimeOfPowers);
  fmpz_mat_get_nmod_mat(modular, matrix);
  // A rank modulo a prime is never above the true one.
  const bool injective = nmod_mat_rank(modular) == degree + 1;
  nmod_mat_clear(modular);
  std::optional<Univariate> result;
  if (!injective) {
    tick();
    fmpz_mat_t basis;
    fmpz_mat_init(basis, degree + 1, degree + 1);
    if (fmpz_mat_nullspace(basis, matrix) > 0) {
      Univariate found;
      for (long j = 0; j <= degree; ++j) {
        Rational entry;
        fmpz_set(fmpq_numref(entry.get()), fmpz_mat_entry(basis, j, 0));
        fmpq_mul_fmpz(entry.get(), entry.get(), images[static_cast<std::size_t>(j)].raw()->den);
        fmpq_poly_set_coeff_fmpq(found.raw(), j, entry.get());
      }
      result = std::move(found);
    }
    fmpz_mat_clear(basis);
  }
  fmpz_mat_clear(matrix);
  return result;
}

}  // namespace

InvariantSearch rational_invariant(const RationalFunction& r,
                                   const std::vector<Singularity>& singular, long m,
                                   const std::function<void()>& tick, const std::string& z) {
  std::vector<long> orders;
  std::vector<std::pair<long, long>> bound;
  RationalFunction known(1);
  long degree = 0;
  for (const Singularity& s : singular) {
    const std::optional<long> order = extreme_order(s, m);
    if (!order) return {{}, fmt::format("no order is an integer at {}", s.text(z))};
    orders.push_back(*order);
    bound.emplace_back(*order, s.at_infinity() ? -1 : s.at.degree());
    if (s.at_infinity()) {
      degree += *order;
    } else {
      degree -= *order * s.at.degree();
      known = known * RationalFunction(s.at).pow(*order);
    }
  }
  const std::string what = fmt::format("invariants of degree {}", m);
  if (degree < 0)
    return {{},
            fmt::format("the orders leave the degree {} < 0", degree),
            {{what, m, {}, degree, false, bound}}};
  if (degree > kLargestDegreeOfPower)
    throw NotDecided(
        fmt::format("an invariant of degree {} may have a numerator of degree {}", m, degree));
  const Recursion map = recursion(r, singular, orders, m);
  const auto p = kernel(map, degree, tick);
  if (!p)
    return {{},
            fmt::format("linear equations for a polynomial of degree {} at most have the "
                        "solution 0 only",
                        degree),
            {{what,
              m,
              {coefficients_of(map.g), coefficients_of(map.g_slope),
               coefficients_of(map.g_logarithmic), coefficients_of(map.g_squared_r)},
              degree,
              false,
              bound}}};
  return {known * RationalFunction(*p), {}};
}

Univariate symmetric_power_image(const std::vector<Univariate>& coefficients, long m,
                                 const Univariate& polynomial) {
  return Recursion{m, coefficients[0], coefficients[1], coefficients[2], coefficients[3]}.last(
      polynomial);
}

std::vector<RationalFunction> form_polynomial(const RationalFunction& r,
                                              const RationalFunction& phi, long m) {
  std::vector<RationalFunction> coefficients(static_cast<std::size_t>(m) + 1);
  RationalFunction above, current(-1);
  cln::cl_RA factorial = 1;
  for (long i = m; i >= 0; --i) {
    if (i < m) factorial = factorial * cln::cl_RA(m - i);
    coefficients[static_cast<std::size_t>(i)] = RationalFunction(-1 / factorial) * current;
    RationalFunction next = -current.derivative() - phi * current -
                            RationalFunction(cln::cl_RA((m - i) * (i + 1))) * r * above;
    above = std::move(current);
    current = std::move(next);
  }
  if (!current.is_zero()) return {};
  return coefficients;
}

bool solves_riccati(const std::vector<RationalFunction>& polynomial, const RationalFunction& r) {
  const std::size_t m = polynomial.size() - 1;
  // F_z + F_w (r - w^2), of degree m + 1 in w.
  std::vector<RationalFunction> rest(m + 2);
  for (std::size_t i = 0; i <= m; ++i) {
    rest[i] = rest[i] + polynomial[i].derivative();
    if (i == 0) continue;
    const RationalFunction slope =
        RationalFunction(cln::cl_RA(static_cast<long>(i))) * polynomial[i];
    rest[i - 1] = rest[i - 1] + slope * r;
    rest[i + 1] = rest[i + 1] - slope;
  }
  for (std::size_t top = m + 1; top >= m; --top) {
    const RationalFunction factor = rest[top];
    for (std::size_t i = 0; i <= m; ++i)
      rest[top - m + i] = rest[top - m + i] - factor * polynomial[i];
  }
  return std::all_of(rest.begin(), rest.end(), [](const auto& c) { return c.is_zero(); });
}

}  // namespace casimir::obstruction
