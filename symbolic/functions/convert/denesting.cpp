// Roots of sums with roots, where they are sums of simpler roots.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

#include "symbolic/functions/convert/roots.hpp"

namespace casimir::functions {
namespace {

/// The q-th root of `p` as a polynomial, for odd q.
std::optional<Polynomial> odd_root(const Polynomial& p, unsigned long q) {
  if (p.is_zero()) return std::nullopt;
  Polynomial result = p.ring().constant(1);
  for (const auto& [f, exponent] : p.factors()) {
    if (!f.is_constant()) {
      if (exponent % q != 0) return std::nullopt;
      result *= f.pow(exponent / q);
      continue;
    }
    const cln::cl_RA number = f.term_list()[0].first;
    cln::cl_RA size = 0;
    if (!cln::rootp(cln::abs(number), static_cast<int>(q), &size)) return std::nullopt;
    result = result.scaled(cln::minusp(number) ? -size : size);
  }
  return result;
}

/// A square root of `p` as a polynomial in the generators, of either sign.
std::optional<Polynomial> square_root(const Polynomial& p) {
  if (p.is_zero()) return p;
  Polynomial result = p.ring().constant(1);
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

/// The polynomials T with D_q(T, n) = 2 a, where D_0 = 2, D_1 = T, D_(k+1) = T D_k - n D_(k-1).
/// \param free  the place of a variable that a and n do not use
std::vector<Polynomial> traces(const Polynomial& a, const Polynomial& n, unsigned long q,
                               std::size_t free) {
  constexpr std::size_t kMostTerms = 400;
  const Polynomial t = a.ring().variable(free);
  Polynomial before = a.ring().constant(2), dickson = t;
  for (unsigned long k = 1; k < q; ++k) {
    Polynomial next = t * dickson - n * before;
    if (next.terms() > kMostTerms) return {};
    before = std::move(dickson);
    dickson = std::move(next);
  }
  std::vector<Polynomial> result;
  for (const auto& [f, exponent] : (dickson - a.scaled(2)).factors()) {
    if (f.degree(free) != 1) continue;
    const std::vector<Polynomial> line = f.coefficients(free);
    if (line[1].is_constant()) result.push_back(line[0].scaled(-1 / line[1].term_list()[0].first));
  }
  return result;
}

}  // namespace

/// sqrt(A + B g), where g = sqrt(b) is a root that A and B do not contain, and A^2 - B^2 b = D^2:
/// with X = (A + D)/2 and Y = (A - D)/2 it is
///   sqrt(X) + sqrt(Y)                                            where B >= 0,
///   sqrt(X) - sqrt(Y) for D >= 0, sqrt(Y) - sqrt(X) for D <= 0   where B <= 0,
/// if neither X nor Y is negative: the square is A +- 2 sqrt(X Y) = A +- |B| g, and no side is
/// negative. Without X, Y >= 0 the roots would not be real; without a sign of D, sqrt(a + b - 2
/// sqrt(a b)) is |sqrt(a) - sqrt(b)|. All of it holds where some of these vanish.
std::optional<Polynomial> Roots::denested(const Polynomial& radicand) {
  const cln::cl_RA half = cln::cl_RA(1) / 2;
  for (std::size_t g = table_.generators().size(); g-- > 0;) {
    const std::size_t place = table_.place(g);
    if (table_.generators()[g].kind != Kind::root || table_.generators()[g].order % 2 == 1 ||
        !radicand.uses(place))
      continue;
    const std::vector<Polynomial> parts = radicand.coefficients(place);
    const std::size_t middle = table_.generators()[g].order / 2;
    bool quadratic = parts.size() == middle + 1;
    for (std::size_t k = 1; k < parts.size() && quadratic; ++k)
      quadratic = k == middle || parts[k].is_zero();
    if (!quadratic || parts[0].is_zero()) continue;
    const Polynomial& a = parts[0];
    const Polynomial& b = parts[middle];
    const Polynomial norm = table_.reduced(
        table_.checked_product(a, a) -
        table_.checked_product(table_.checked_product(b, b), table_.generators()[g].base));
    const auto d = square_root(norm);
    if (!d) continue;
    const Polynomial x = (a + *d).scaled(half), y = (a - *d).scaled(half);
    const int sign = signs_.sign_of(b);
    if (sign == 0 || (!x.is_zero() && signs_.sign_of(x) <= 0) ||
        (!y.is_zero() && signs_.sign_of(y) <= 0))
      continue;
    const int order = d->is_zero() ? 1 : signs_.sign_of(*d);
    if (sign < 0 && order == 0) continue;
    const Polynomial first = root(x, 2);
    const Polynomial second = root(y, 2);
    return sign > 0 ? first + second : order > 0 ? first - second : second - first;
  }
  return std::nullopt;
}

/// P^(1/q) for odd q and P = A + B g, where g = sqrt(b) is a root that A and B do not contain: a
/// root r = t + w g with such t and w has the norm n with n^q = A^2 - B^2 b, and a trace T with
/// D_q(T, n) = 2 A for Dickson's polynomial. What is found so is a root since its power is P, and
/// it is the real one, of which there is one alone: P is positive if it is a number, and where a
/// function P is negative its root has no value. So P must not be negative everywhere.
std::optional<Polynomial> Roots::denested_number(const Polynomial& radicand, unsigned long q) {
  constexpr unsigned long kMostOrder = 16;
  constexpr std::size_t kMostTerms = 60;
  if (q % 2 == 0 || q > kMostOrder || radicand.is_constant() || radicand.terms() > kMostTerms)
    return std::nullopt;
  // In place of T, a symbol that is not there.
  std::size_t free = 0;
  while (free < table_.symbols().size() && radicand.uses(free)) ++free;
  if (free == table_.symbols().size()) return std::nullopt;
  for (std::size_t k = table_.generators().size(); k-- > 0;) {
    const Generator& g = table_.generators()[k];
    const std::size_t place = table_.place(k);
    if (g.kind != Kind::root || g.order % 2 == 1 || !radicand.uses(place)) continue;
    const std::vector<Polynomial> parts = radicand.coefficients(place);
    const std::size_t middle = g.order / 2;
    if (parts.size() != middle + 1 || g.base.uses(free)) continue;
    if (std::any_of(parts.begin() + 1, parts.end() - 1,
                    [](const Polynomial& part) { return !part.is_zero(); }))
      continue;
    const Polynomial norm = table_.reduced(
        table_.checked_product(parts[0], parts[0]) -
        table_.checked_product(table_.checked_product(parts[middle], parts[middle]), g.base));
    const std::optional<Polynomial> n = odd_root(norm, q);
    if (!n || n->uses(free)) continue;
    for (const Polynomial& trace : traces(parts[0], *n, q, free)) {
      Polynomial square = table_.reduced(trace * trace - n->scaled(4));
      if (!square.divide(g.base, &square)) continue;
      const std::optional<Polynomial> w = square_root(square);
      if (!w) continue;
      for (const int sign : {1, -1}) {
        const Polynomial root =
            (trace + (*w * table_.ring().variable(place).pow(middle)).scaled(sign))
                .scaled(cln::cl_RA(1) / 2);
        if (!table_.reduced(table_.power(root, q) - radicand).is_zero()) continue;
        const std::optional<int> of_number = signs_.sign_of_number(radicand);
        if (of_number ? *of_number > 0 : signs_.sign_of(radicand) >= 0) return root;
      }
    }
  }
  return std::nullopt;
}

}  // namespace casimir::functions
