// Roots of sums with roots in a FunctionRing, where they are sums of simpler roots.
#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/functions/function_ring.hpp"

namespace casimir {

/// A square root of `p` as a polynomial in the generators, of either sign.
std::optional<Polynomial> FunctionRing::square_root(const Polynomial& p) const {
  if (p.is_zero()) return p;
  Polynomial result = ring_->constant(1);
  for (const auto& [f, exponent] : p.factors()) {
    if (f.is_constant()) {
      cln::cl_RA value = 0;
      const cln::cl_RA number = f.term_list()[0].first;
      if (cln::minusp(number) || !cln::sqrtp(number, &value)) return std::nullopt;
      result = result.scaled(value);
      continue;
    }
    if (exponent % 2 == 1) return std::nullopt;
    result *= f.pow(exponent / 2);
  }
  return result;
}

/// sqrt(A + B g), where g = sqrt(b) is a root that A and B do not contain, and A^2 - B^2 b = D^2:
/// with X = (A + D)/2 and Y = (A - D)/2 it is
///   sqrt(X) + sqrt(Y)                                            where B >= 0,
///   sqrt(X) - sqrt(Y) for D >= 0, sqrt(Y) - sqrt(X) for D <= 0   where B <= 0,
/// if neither X nor Y is negative: the square is A +- 2 sqrt(X Y) = A +- |B| g, and no side is
/// negative. Without X, Y >= 0 the roots would not be real; without a sign of D, sqrt(a + b - 2
/// sqrt(a b)) is |sqrt(a) - sqrt(b)|. All of it holds where some of these vanish.
std::optional<Polynomial> FunctionRing::denested(const Polynomial& radicand) {
  const cln::cl_RA half = cln::cl_RA(1) / 2;
  for (std::size_t g = generators_.size(); g-- > 0;) {
    const std::size_t place = symbols_.size() + g;
    if (generators_[g].kind != Kind::root || generators_[g].order % 2 == 1 || !radicand.uses(place))
      continue;
    const std::vector<Polynomial> parts = radicand.coefficients(place);
    const std::size_t middle = generators_[g].order / 2;
    bool quadratic = parts.size() == middle + 1;
    for (std::size_t k = 1; k < parts.size() && quadratic; ++k)
      quadratic = k == middle || parts[k].is_zero();
    if (!quadratic || parts[0].is_zero()) continue;
    const Polynomial& a = parts[0];
    const Polynomial& b = parts[middle];
    const Polynomial norm = reduced(checked_product(a, a) -
                                    checked_product(checked_product(b, b), generators_[g].base));
    const auto d = square_root(norm);
    if (!d) continue;
    const Polynomial x = (a + *d).scaled(half), y = (a - *d).scaled(half);
    const int sign = sign_of(b);
    if (sign == 0 || (!x.is_zero() && sign_of(x) <= 0) || (!y.is_zero() && sign_of(y) <= 0))
      continue;
    const int order = d->is_zero() ? 1 : sign_of(*d);
    if (sign < 0 && order == 0) continue;
    const Polynomial first = root(x, 2);
    const Polynomial second = root(y, 2);
    return sign > 0 ? first + second : order > 0 ? first - second : second - first;
  }
  return std::nullopt;
}

/// P^(1/q) for a positive number P = A + B g with rational A and B, and g = sqrt(b): a root t + w g
/// in the same field has the norm n with n^q = A^2 - B^2 b, and a trace t with D_q(t, n) = 2 A for
/// Dickson's polynomial. What is found so is a root since its power is P, and it is the positive
/// one by its sign, which balls certify.
std::optional<Polynomial> FunctionRing::denested_number(const Polynomial& radicand,
                                                        unsigned long q) {
  constexpr unsigned long kMostOrder = 16;
  if (q % 2 == 0 || q > kMostOrder || ring_->size() == 0 || radicand.is_constant())
    return std::nullopt;
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < ring_->size(); ++i) {
    if (!radicand.uses(i)) continue;
    if (only || i < symbols_.size()) return std::nullopt;
    only = i;
  }
  const Generator& g = generators_[*only - symbols_.size()];
  if (g.kind != Kind::root || g.order != 2 || !g.base.is_constant() || radicand.degree(*only) != 1)
    return std::nullopt;
  const std::vector<Polynomial> parts = radicand.coefficients(*only);
  const auto number = [](const Polynomial& p) {
    return p.is_zero() ? cln::cl_RA(0) : p.term_list()[0].first;
  };
  const cln::cl_RA a = number(parts[0]), b = number(parts[1]), base = number(g.base);
  const cln::cl_RA norm = a * a - b * b * base;
  cln::cl_RA n = 0;
  if (!cln::rootp(cln::abs(norm), static_cast<int>(q), &n)) return std::nullopt;
  if (cln::minusp(norm)) n = -n;
  const Polynomial t = ring_->variable(0);
  Polynomial before = ring_->constant(2), dickson = t;
  for (unsigned long k = 1; k < q; ++k) {
    Polynomial next = t * dickson - before.scaled(n);
    before = std::move(dickson);
    dickson = std::move(next);
  }
  const Polynomial equation = dickson - ring_->constant(2 * a);
  for (const auto& [f, exponent] : equation.factors()) {
    if (f.total_degree() != 1) continue;
    const std::vector<Polynomial> line = f.coefficients(0);
    const cln::cl_RA trace = -number(line[0]) / number(line[1]);
    cln::cl_RA w = 0;
    const cln::cl_RA square = (trace * trace - 4 * n) / base;
    if (cln::minusp(square) || !cln::sqrtp(square, &w)) continue;
    for (const int sign : {1, -1}) {
      const Polynomial root = (ring_->constant(trace) + ring_->variable(*only).scaled(sign * w))
                                  .scaled(cln::cl_RA(1) / 2);
      if (sign_of_number(root) == 1 && reduced(power(root, q) - radicand).is_zero()) return root;
    }
  }
  return std::nullopt;
}

}  // namespace casimir
