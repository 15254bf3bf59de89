#include "symbolic/obstruction/points/zero_dimensional.hpp"

#include <flint/fmpq_mat.h>

#include <algorithm>
#include <map>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/ideal.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

constexpr std::size_t kMostZeros = 150;
/// Beyond these a basis is given up: what it leaves is no basis, and finds fewer zeros or none.
constexpr GroebnerLimits kLimitsOfPoints{
    .reductions = 600, .elements = 100, .terms = 1000, .bits = 3000};

using Exponents = std::vector<unsigned long>;
using Vector = std::vector<cln::cl_RA>;

bool divides(const Exponents& a, const Exponents& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] > b[i]) return false;
  return true;
}

/// The algebra of polynomials modulo an ideal, with the monomials that lead none of its elements as
/// a basis.
class Quotient {
 public:
  explicit Quotient(std::vector<Polynomial> basis, const PolynomialRing& ring)
      : basis_(std::move(basis)) {
    for (const Polynomial& p : basis_) {
      if (p.is_zero()) continue;
      leading_.push_back(p.term_list().front().second);
    }
    for (std::size_t i = 0; i < ring.size(); ++i)
      finite_ = finite_ && std::any_of(leading_.begin(), leading_.end(), [&](const auto& e) {
                  for (std::size_t j = 0; j < e.size(); ++j)
                    if (j != i && e[j] != 0) return false;
                  return true;  // a power of one variable, or 1
                });
    if (finite_) collect(Exponents(ring.size(), 0), 0);
  }

  bool finite() const { return finite_; }
  std::size_t size() const { return monomials_.size(); }

  Vector coordinates(const Polynomial& p) const {
    Vector result(size(), 0);
    for (const auto& [coefficient, exponents] : reduced(p).term_list()) {
      const auto place = places_.find(exponents);
      if (place == places_.end()) throw NotDecided("no Groebner basis was found");
      result[place->second] = coefficient;
    }
    return result;
  }
  Polynomial reduced(const Polynomial& p) const {
    std::vector<Polynomial> quotients;
    return p.remainder(basis_, &quotients);
  }

 private:
  void collect(const Exponents& monomial, std::size_t from) {
    if (std::any_of(leading_.begin(), leading_.end(),
                    [&](const auto& e) { return divides(e, monomial); }))
      return;
    if (size() >= kMostZeros) throw NotDecided("more than 150 common zeros");
    places_.emplace(monomial, size());
    monomials_.push_back(monomial);
    for (std::size_t i = from; i < monomial.size(); ++i) {
      Exponents next = monomial;
      ++next[i];
      collect(next, i);
    }
  }

  std::vector<Polynomial> basis_;
  std::vector<Exponents> leading_, monomials_;
  std::map<Exponents, std::size_t> places_;
  bool finite_ = true;
};

/// x with columns * x = target, if there is one and the columns are independent.
std::optional<Vector> solve(const std::vector<Vector>& columns, const Vector& target) {
  const auto height = static_cast<long>(target.size()), width = static_cast<long>(columns.size());
  fmpq_mat_t matrix;
  fmpq_mat_init(matrix, height, width + 1);
  for (long i = 0; i < height; ++i)
    for (long j = 0; j <= width; ++j) {
      const Vector& own = j < width ? columns[static_cast<std::size_t>(j)] : target;
      Rational entry(own[static_cast<std::size_t>(i)]);
      fmpq_set(fmpq_mat_entry(matrix, i, j), entry.get());
    }
  const long rank = fmpq_mat_rref(matrix, matrix);
  std::optional<Vector> result;
  if (rank == width &&
      (width == 0 || !fmpq_is_zero(fmpq_mat_entry(matrix, width - 1, width - 1)))) {
    result.emplace();
    for (long i = 0; i < width; ++i) {
      Rational entry;
      fmpq_set(entry.get(), fmpq_mat_entry(matrix, i, width));
      result->push_back(entry.number());
    }
  }
  fmpq_mat_clear(matrix);
  return result;
}

/// The powers 1, p, p^2, .. as far as they are independent, and the monic polynomial that p obeys.
struct Powers {
  std::vector<Vector> list;
  Univariate minimal;
};

Powers powers_of(const Quotient& quotient, const PolynomialRing& ring, const Polynomial& p) {
  Powers result;
  Polynomial power = ring.constant(1);
  while (true) {
    const Vector own = quotient.coordinates(power);
    if (auto relation = solve(result.list, own)) {
      for (cln::cl_RA& c : *relation) c = -c;
      relation->push_back(1);
      result.minimal = Univariate(*relation);
      return result;
    }
    result.list.push_back(own);
    power = quotient.reduced(power * p);
  }
}

Polynomial in_variable(const Univariate& p, const Polynomial& x) {
  Polynomial result = x.ring().constant(0);
  for (long i = p.degree(); i >= 0; --i) result = result * x + x.ring().constant(p.coefficient(i));
  return result;
}

Univariate square_free(const Univariate& p) { return p.divided(gcd(p, p.derivative())).first; }

void add_points(const Quotient& quotient, const PolynomialRing& ring,
                const std::vector<Polynomial>& equations, CommonZeros& result) {
  for (int attempt = 1;; ++attempt) {
    if (attempt > 50) throw NotDecided("no linear form tells the common zeros apart");
    Polynomial form = ring.constant(0);
    long factor = 1;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      form += ring.variable(i).scaled(cln::cl_RA(factor));
      factor = factor * attempt + (i % 2 == 0 ? 1 : -1);
    }
    const Powers powers = powers_of(quotient, ring, form);
    if (powers.list.size() != quotient.size()) continue;
    std::vector<Univariate> coordinates;
    for (std::size_t i = 0; i < ring.size(); ++i)
      coordinates.emplace_back(*solve(powers.list, quotient.coordinates(ring.variable(i))));
    for (const auto& [field, exponent] : powers.minimal.factors()) {
      AlgebraicPoint point{field, {}};
      for (const Univariate& c : coordinates) point.coordinates.push_back(c.remainder(field));
      for (const Polynomial& e : equations)
        if (!value_at(e, point).is_zero()) throw NotDecided("no Groebner basis was found");
      result.points.push_back(std::move(point));
    }
    return;
  }
}

}  // namespace

Univariate value_at(const Polynomial& polynomial, const AlgebraicPoint& point) {
  Univariate result;
  for (const auto& [coefficient, exponents] : polynomial.term_list()) {
    Univariate term(coefficient);
    for (std::size_t i = 0; i < exponents.size(); ++i)
      for (unsigned long k = 0; k < exponents[i]; ++k)
        term = (term * point.coordinates[i]).remainder(point.field);
    result += term;
  }
  return result.remainder(point.field);
}

CommonZeros common_zeros(const std::vector<Polynomial>& equations,
                         const std::function<void()>& tick) {
  const PolynomialRing& ring = equations.front().ring();
  std::vector<Polynomial> basis = groebner_basis(equations, kLimitsOfPoints);
  CommonZeros result;
  tick();
  const Quotient first(basis, ring);
  result.finite = first.finite();
  if (!result.finite || first.size() == 0) return result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Powers powers = powers_of(first, ring, ring.variable(i));
    basis.push_back(in_variable(square_free(powers.minimal), ring.variable(i)));
  }
  tick();
  const Quotient radical(groebner_basis(basis, kLimitsOfPoints), ring);
  tick();
  if (radical.size() > 0) add_points(radical, ring, equations, result);
  return result;
}

}  // namespace casimir::obstruction
