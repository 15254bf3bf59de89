// Parts of inverse functions, and of Pi, as angles.
//
// An inverse function v has a known range, and so the cosines of its parts have known signs. With
//   w = v    of asin, atan, and atan2(y, x) where x >= 0,
//   w = v/2  of acos, and of any atan2,
// |w| <= Pi/2 everywhere, its ends included, and cos w and sin w are algebraic. A part t = w/n with
// n >= 2 has |t| <= Pi/4. So cos t is not zero, cos(w/2) is the root of (1 + cos w)/2 that is
// positive, and U_(n-1)(cos t) = sin(w)/sin(t) vanishes nowhere (sin(n t) = 0 with |n t| <= Pi/2
// makes t = 0, where the quotient is n). With w = Pi, n = 2 it would vanish: hence no more than a
// half is taken of the cut of atan2, and acos(-1), by these means.
#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/convert/angles.hpp"
#include "symbolic/functions/convert/denominators.hpp"

namespace casimir::functions {
namespace {

using GiNaC::ex;

constexpr unsigned long kMostPartsOfAngle = 48;  ///< of an inverse function

/// The integers c_k for which T_n(c) = sum c_k c^k, or U_n for `second`.
std::vector<cln::cl_I> chebyshev(unsigned long n, bool second) {
  std::vector<cln::cl_I> before{1}, now{0, second ? 2 : 1};
  if (n == 0) return before;
  for (unsigned long k = 1; k < n; ++k) {
    std::vector<cln::cl_I> next(now.size() + 1, 0);
    for (std::size_t i = 0; i < now.size(); ++i) next[i + 1] = 2 * now[i];
    for (std::size_t i = 0; i < before.size(); ++i) next[i] = next[i] - before[i];
    before = std::move(now);
    now = std::move(next);
  }
  return now;
}

}  // namespace

/// Sine and cosine of an angle that is a generator of an inverse function, or Pi, by algebra.
std::optional<Angles::PartOfAngle> Angles::algebraic_sine_cosine(
    const cln::cl_RA& coefficient, const std::vector<unsigned long>& monomial) {
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    if (monomial[i] == 0) continue;
    if (only || monomial[i] > 1 || i < table_.symbols().size()) return std::nullopt;
    only = i - table_.symbols().size();
  }
  if (!only || table_.generators()[*only].kind != Kind::function) return std::nullopt;
  const unsigned long tag = table_.generators()[*only].order;
  if (tag == kConstant) {
    if (!table_.generators()[*only].value.is_equal(GiNaC::Pi)) return std::nullopt;
    auto part = pi_.sine_cosine(coefficient);
    if (!part) return std::nullopt;
    return PartOfAngle{std::move(part->first), std::move(part->second), 1};
  }
  const bool arc =
      tag == kArcTangent || tag == kArcSine || tag == kArcCosine || tag == kArcTangentOfTwo;
  if (!arc) return std::nullopt;
  // On the cuts of complex inverse functions the sign of the root is a convention.
  if (table_.is_complex()) {
    if (tag == kArcSine || tag == kArcCosine || cln::denominator(coefficient) != 1)
      return std::nullopt;
    auto [s, c] = inverse_sine_cosine(ex(table_.generators()[*only].value), tag);
    return PartOfAngle{std::move(s), std::move(c), cln::numerator(coefficient)};
  }
  const auto [unit, times] = units_.unit_of(monomial, coefficient);
  const cln::cl_I parts = cln::denominator(unit.term_list()[0].first);
  auto part = part_of_inverse(*only, parts);
  if (part) part->times = part->times * times;
  return part;
}

std::pair<Polynomial, Polynomial> Angles::inverse_sine_cosine(const ex& value, unsigned long tag) {
  const Polynomial one = table_.ring().constant(1);
  const Polynomial v = convert_(value.op(0));
  switch (tag) {
    case kArcTangent: {
      const Polynomial c = inverse_of(table_, roots_.root(one + v * v, 2));
      return std::pair(table_.checked_product(v, c), c);
    }
    case kArcSine:
      return std::pair(v, roots_.root(one - v * v, 2));
    case kArcCosine:
      return std::pair(roots_.root(one - v * v, 2), v);
    default: {
      const Polynomial x = convert_(value.op(1));
      const Polynomial over = inverse_of(table_, roots_.root(x * x + v * v, 2));
      return std::pair(table_.checked_product(v, over), table_.checked_product(x, over));
    }
  }
}

/// w of the comment above, and 1 or 2 as the number of times that v contains it; asin(u)/2 and
/// acos(u)/2 have the roots of 1 + u and 1 - u, which are real where these functions are:
///   cos(acos(u)/2) = sqrt((1 + u)/2), sin(acos(u)/2) = sqrt((1 - u)/2)   on [0, Pi/2]
///   asin(u)/2 = Pi/4 - acos(u)/2
std::optional<Angles::PartOfAngle> Angles::first_part(std::size_t index, bool half) {
  const Generator own = table_.generators()[index];
  const Polynomial one = table_.ring().constant(1);
  const Polynomial u = convert_(own.value.op(0));
  if (own.order == kArcCosine || (own.order == kArcSine && half)) {
    const cln::cl_RA middle = cln::cl_RA(1) / 2;
    if (own.order == kArcCosine)
      return PartOfAngle{roots_.root((one - u).scaled(middle), 2),
                         roots_.root((one + u).scaled(middle), 2), 2};
    const Polynomial plus = roots_.root(one + u, 2), minus = roots_.root(one - u, 2);
    return PartOfAngle{(plus - minus).scaled(middle), (plus + minus).scaled(middle), 2};
  }
  if (own.order != kArcTangentOfTwo || signs_.sign_of(convert_(own.value.op(1))) > 0) {
    auto [s, c] = inverse_sine_cosine(own.value, own.order);
    return PartOfAngle{std::move(s), std::move(c), 1};
  }
  // cos(v/2) >= 0 on (-Pi, Pi]; on the cut, where it is 0, sin(v/2) is 1.
  const Polynomial x = convert_(own.value.op(1));
  const Polynomial r = roots_.root(x * x + u * u, 2);
  const Polynomial q = roots_.root(r + x, 2);
  const auto terms = q.term_list();
  const bool single = terms.size() == 1 && terms[0].first == 1 && q.total_degree() == 1;
  if (!single) return std::nullopt;
  const Polynomial s = half_sine(index, r, x, u, q);
  const Polynomial over = inverse_of(table_, roots_.root(r + r, 2));
  return PartOfAngle{table_.checked_product(s, over), table_.checked_product(q, over), 2};
}

/// G = sqrt(2 r) sin(v/2) for v = atan2(y, x), with Q = sqrt(r + x) = sqrt(2 r) cos(v/2):
/// G^2 = r - x and G Q = r sin v = y. Neither is divided by, since Q = 0 on the cut. They have no
/// common zero, as G^2 + Q^2 = 2 r, and atan2 has no value where r = 0.
Polynomial Angles::half_sine(std::size_t index, const Polynomial& r, const Polynomial& x,
                             const Polynomial& y, const Polynomial& q) {
  const Polynomial unit = table_.variable(index).scaled(cln::cl_RA(1) / 2);
  std::size_t known = 0;
  if (table_.find(Kind::function, unit, kSignedHalf, &known) != nullptr)
    return table_.variable(known);
  const Polynomial over = inverse_of(table_, r + r);
  const ex value = GiNaC::sqrt(2 * table_.expression(r)) * GiNaC::sin(table_.expression(unit));
  const std::vector<Polynomial> unit_slopes = table_.slopes(unit), r_slopes = table_.slopes(r);
  const Polynomial s =
      table_.generator(Kind::function, value, unit, kSignedHalf,
                       [&](const Polynomial&) { return Polynomial(table_.ring()); });
  Generator& own = table_.last();
  for (std::size_t i = 0; i < table_.symbols().size(); ++i)
    own.derivatives[i] = table_.checked_product(table_.checked_product(r_slopes[i], over), s) +
                         table_.checked_product(q, unit_slopes[i]);
  own.relation = {r - x, Polynomial(table_.ring())};
  std::size_t place = table_.symbols().size();
  while (!q.uses(place)) ++place;
  own.partner = {place, y};
  return s;
}

/// cos(unit) with T_n(cos(unit)) = whole.
Polynomial Angles::part_cosine(const Polynomial& unit, const Polynomial& whole, unsigned long n) {
  std::size_t known = 0;
  if (table_.find(Kind::function, unit, kPartCosine, &known) != nullptr)
    return table_.variable(known);
  // Its sine stands behind it.
  if (!table_.has_room(2)) table_.grow();
  const Polynomial sine =
      table_.ring().variable(table_.symbols().size() + table_.generators().size() + 1);
  const Polynomial c = table_.generator(
      Kind::function, GiNaC::cos(table_.expression(unit)), unit, kPartCosine,
      [&](const Polynomial& slope) { return -table_.checked_product(sine, slope); });
  const std::vector<cln::cl_I> t = chebyshev(n, false);
  std::vector<Polynomial>& relation = table_.last().relation;
  const cln::cl_RA over = 1 / cln::cl_RA(t[n]);
  for (unsigned long k = 0; k < n; ++k) relation.push_back(table_.ring().constant(-t[k] * over));
  relation[0] += whole.scaled(over);
  return c;
}

/// sin(unit) with sin(unit) times = whole, where `times` vanishes nowhere.
Polynomial Angles::part_sine(const Polynomial& unit, const Polynomial& cosine,
                             const Polynomial& times, const Polynomial& whole) {
  std::size_t known = 0;
  if (table_.find(Kind::function, unit, kPartSine, &known) != nullptr)
    return table_.variable(known);
  const Polynomial s = table_.generator(
      Kind::function, GiNaC::sin(table_.expression(unit)), unit, kPartSine,
      [&](const Polynomial& slope) { return table_.checked_product(cosine, slope); });
  Generator& own = table_.last();
  own.relation = {table_.ring().constant(1) - table_.checked_product(cosine, cosine),
                  Polynomial(table_.ring())};
  own.quotient = {times, whole};
  return s;
}

/// The angle v/(parts * times) with its multiple `times` that is v/parts.
std::optional<Angles::PartOfAngle> Angles::part_of_inverse(std::size_t index,
                                                           const cln::cl_I& parts) {
  const Polynomial v = table_.variable(index);
  if (parts == 1) {
    auto [s, c] =
        inverse_sine_cosine(ex(table_.generators()[index].value), table_.generators()[index].order);
    return PartOfAngle{std::move(s), std::move(c), 1};
  }
  if (parts > kMostPartsOfAngle) return std::nullopt;
  unsigned long n = machine_word(parts);
  auto part = first_part(index, n % 2 == 0);
  if (!part) return std::nullopt;
  auto& [s, c, times] = *part;
  Polynomial angle = v.scaled(1 / cln::cl_RA(times));
  if (times == 2 && n % 2 == 0) {
    n /= 2;
    times = 1;
  }
  const Polynomial one = table_.ring().constant(1);
  for (; n % 2 == 0; n /= 2) {
    angle = angle.scaled(cln::cl_RA(1) / 2);
    c = roots_.root((one + c).scaled(cln::cl_RA(1) / 2), 2);
    s = part_sine(angle, c, c + c, s);
  }
  if (n == 1) return part;
  angle = angle.scaled(1 / cln::cl_RA(cln::cl_I(n)));
  c = part_cosine(angle, c, n);
  const std::vector<cln::cl_I> u = chebyshev(n - 1, true);
  Polynomial quotient(table_.ring());
  for (std::size_t k = u.size(); k-- > 0;) quotient = quotient * c + table_.ring().constant(u[k]);
  s = part_sine(angle, c, quotient, s);
  return part;
}

}  // namespace casimir::functions
