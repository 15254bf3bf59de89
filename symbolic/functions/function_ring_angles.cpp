// Parts of inverse functions, and of Pi, as angles in a FunctionRing.
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
#include <flint/fmpz_poly.h>
#include <flint/ulong_extras.h>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr unsigned long kMostParts = 48;  ///< of an inverse function
constexpr unsigned long kMostPiParts = 240;
constexpr unsigned long kMostPiDegree = 32;  ///< of the cosine of a part of Pi

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

/// The minimal polynomial of 2 cos(2 Pi/n), by FLINT.
std::vector<cln::cl_I> minimal_polynomial_of_cosine(unsigned long n) {
  fmpz_poly_t polynomial;
  fmpz_poly_init(polynomial);
  fmpz_poly_cos_minpoly(polynomial, n);
  std::vector<cln::cl_I> result;
  for (slong i = 0; i < fmpz_poly_length(polynomial); ++i)
    result.push_back(from_fmpz(fmpz_poly_get_coeff_ptr(polynomial, i)));
  fmpz_poly_clear(polynomial);
  return result;
}

}  // namespace

/// Sine and cosine of an angle that is a generator of an inverse function, or Pi, by algebra.
std::optional<FunctionRing::PartOfAngle> FunctionRing::algebraic_sine_cosine(
    const cln::cl_RA& coefficient, const std::vector<unsigned long>& monomial) {
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    if (monomial[i] == 0) continue;
    if (only || monomial[i] > 1 || i < symbols_.size()) return std::nullopt;
    only = i - symbols_.size();
  }
  if (!only || generators_[*only].kind != Kind::function) return std::nullopt;
  const unsigned long tag = generators_[*only].order;
  if (tag == kConstant) {
    if (!generators_[*only].value.is_equal(GiNaC::Pi)) return std::nullopt;
    auto part = sine_cosine_of_pi(coefficient);
    if (!part) return std::nullopt;
    return PartOfAngle{std::move(part->first), std::move(part->second), 1};
  }
  const bool arc =
      tag == kArcTangent || tag == kArcSine || tag == kArcCosine || tag == kArcTangentOfTwo;
  if (!arc) return std::nullopt;
  // On the cuts of complex inverse functions the sign of the root is a convention.
  if (complex_) {
    if (tag == kArcSine || tag == kArcCosine || cln::denominator(coefficient) != 1)
      return std::nullopt;
    auto [s, c] = inverse_sine_cosine(generators_[*only]);
    return PartOfAngle{std::move(s), std::move(c), cln::numerator(coefficient)};
  }
  const auto [unit, times] = unit_of(monomial, coefficient);
  const cln::cl_I parts = cln::denominator(unit.term_list()[0].first);
  auto part = part_of_inverse(*only, parts);
  if (part) part->times = part->times * times;
  return part;
}

/// Of an inverse function as it is.
std::pair<Polynomial, Polynomial> FunctionRing::inverse_sine_cosine(const Generator& g) {
  const ex value = g.value;
  const unsigned long tag = g.order;
  const Polynomial one = ring_->constant(1);
  const Polynomial v = convert(value.op(0));
  switch (tag) {
    case kArcTangent: {
      const Polynomial c = inverse(root(one + v * v, 2));
      return std::pair(checked_product(v, c), c);
    }
    case kArcSine:
      return std::pair(v, root(one - v * v, 2));
    case kArcCosine:
      return std::pair(root(one - v * v, 2), v);
    default: {
      const Polynomial x = convert(value.op(1));
      const Polynomial over = inverse(root(x * x + v * v, 2));
      return std::pair(checked_product(v, over), checked_product(x, over));
    }
  }
}

/// w of the comment above, and 1 or 2 as the number of times that v contains it; asin(u)/2 and
/// acos(u)/2 have the roots of 1 + u and 1 - u, which are real where these functions are:
///   cos(acos(u)/2) = sqrt((1 + u)/2), sin(acos(u)/2) = sqrt((1 - u)/2)   on [0, Pi/2]
///   asin(u)/2 = Pi/4 - acos(u)/2
std::optional<FunctionRing::PartOfAngle> FunctionRing::first_part(std::size_t index, bool half) {
  const Generator own = generators_[index];
  const Polynomial one = ring_->constant(1);
  const Polynomial u = convert(own.value.op(0));
  if (own.order == kArcCosine || (own.order == kArcSine && half)) {
    const cln::cl_RA middle = cln::cl_RA(1) / 2;
    if (own.order == kArcCosine)
      return PartOfAngle{root((one - u).scaled(middle), 2), root((one + u).scaled(middle), 2), 2};
    const Polynomial plus = root(one + u, 2), minus = root(one - u, 2);
    return PartOfAngle{(plus - minus).scaled(middle), (plus + minus).scaled(middle), 2};
  }
  if (own.order != kArcTangentOfTwo || sign_of(convert(own.value.op(1))) > 0) {
    auto [s, c] = inverse_sine_cosine(own);
    return PartOfAngle{std::move(s), std::move(c), 1};
  }
  // cos(v/2) >= 0 on (-Pi, Pi]; on the cut, where it is 0, sin(v/2) is 1.
  const Polynomial x = convert(own.value.op(1));
  const Polynomial r = root(x * x + u * u, 2);
  const Polynomial q = root(r + x, 2);
  const auto terms = q.term_list();
  const bool single = terms.size() == 1 && terms[0].first == 1 && q.total_degree() == 1;
  if (!single) return std::nullopt;
  const Polynomial s = half_sine(index, r, x, u, q);
  const Polynomial over = inverse(root(r + r, 2));
  return PartOfAngle{checked_product(s, over), checked_product(q, over), 2};
}

/// G = sqrt(2 r) sin(v/2) for v = atan2(y, x), with Q = sqrt(r + x) = sqrt(2 r) cos(v/2):
/// G^2 = r - x and G Q = r sin v = y. Neither is divided by, since Q = 0 on the cut. They have no
/// common zero, as G^2 + Q^2 = 2 r, and atan2 has no value where r = 0.
Polynomial FunctionRing::half_sine(std::size_t index, const Polynomial& r, const Polynomial& x,
                                   const Polynomial& y, const Polynomial& q) {
  const Polynomial unit = ring_->variable(symbols_.size() + index).scaled(cln::cl_RA(1) / 2);
  std::size_t known = 0;
  if (find(Kind::function, unit, kSignedHalf, &known) != nullptr)
    return ring_->variable(symbols_.size() + known);
  const Polynomial over = inverse(r + r);
  const ex value = GiNaC::sqrt(2 * expression(r)) * GiNaC::sin(expression(unit));
  const std::vector<Polynomial> unit_slopes = slopes(unit), r_slopes = slopes(r);
  const Polynomial s = generator(Kind::function, value, unit, kSignedHalf,
                                 [&](const Polynomial&) { return Polynomial(*ring_); });
  Generator& own = generators_.back();
  for (std::size_t i = 0; i < symbols_.size(); ++i)
    own.derivatives[i] =
        checked_product(checked_product(r_slopes[i], over), s) + checked_product(q, unit_slopes[i]);
  own.relation = {r - x, Polynomial(*ring_)};
  std::size_t place = symbols_.size();
  while (!q.uses(place)) ++place;
  own.partner = {place, y};
  return s;
}

/// cos(unit) with T_n(cos(unit)) = whole.
Polynomial FunctionRing::part_cosine(const Polynomial& unit, const Polynomial& whole,
                                     unsigned long n) {
  std::size_t known = 0;
  if (find(Kind::function, unit, kPartCosine, &known) != nullptr)
    return ring_->variable(symbols_.size() + known);
  // Its sine stands behind it.
  if (generators_.size() + 2 > capacity_) grow();
  const Polynomial sine = ring_->variable(symbols_.size() + generators_.size() + 1);
  const Polynomial c =
      generator(Kind::function, GiNaC::cos(expression(unit)), unit, kPartCosine,
                [&](const Polynomial& slope) { return -checked_product(sine, slope); });
  const std::vector<cln::cl_I> t = chebyshev(n, false);
  std::vector<Polynomial>& relation = generators_.back().relation;
  const cln::cl_RA over = 1 / cln::cl_RA(t[n]);
  for (unsigned long k = 0; k < n; ++k) relation.push_back(ring_->constant(-t[k] * over));
  relation[0] += whole.scaled(over);
  return c;
}

/// sin(unit) with sin(unit) times = whole, where `times` vanishes nowhere.
Polynomial FunctionRing::part_sine(const Polynomial& unit, const Polynomial& cosine,
                                   const Polynomial& times, const Polynomial& whole) {
  std::size_t known = 0;
  if (find(Kind::function, unit, kPartSine, &known) != nullptr)
    return ring_->variable(symbols_.size() + known);
  const Polynomial s =
      generator(Kind::function, GiNaC::sin(expression(unit)), unit, kPartSine,
                [&](const Polynomial& slope) { return checked_product(cosine, slope); });
  Generator& own = generators_.back();
  own.relation = {ring_->constant(1) - checked_product(cosine, cosine), Polynomial(*ring_)};
  own.quotient = {times, whole};
  return s;
}

/// The angle v/(parts * times) with its multiple `times` that is v/parts.
std::optional<FunctionRing::PartOfAngle> FunctionRing::part_of_inverse(std::size_t index,
                                                                       const cln::cl_I& parts) {
  const Polynomial v = ring_->variable(symbols_.size() + index);
  if (parts == 1) {
    auto [s, c] = inverse_sine_cosine(generators_[index]);
    return PartOfAngle{std::move(s), std::move(c), 1};
  }
  if (parts > kMostParts) return std::nullopt;
  unsigned long n = machine_word(parts);
  auto part = first_part(index, n % 2 == 0);
  if (!part) return std::nullopt;
  auto& [s, c, times] = *part;
  Polynomial angle = v.scaled(1 / cln::cl_RA(times));
  if (times == 2 && n % 2 == 0) {
    n /= 2;
    times = 1;
  }
  const Polynomial one = ring_->constant(1);
  for (; n % 2 == 0; n /= 2) {
    angle = angle.scaled(cln::cl_RA(1) / 2);
    c = root((one + c).scaled(cln::cl_RA(1) / 2), 2);
    s = part_sine(angle, c, c + c, s);
  }
  if (n == 1) return part;
  angle = angle.scaled(1 / cln::cl_RA(cln::cl_I(n)));
  c = part_cosine(angle, c, n);
  const std::vector<cln::cl_I> u = chebyshev(n - 1, true);
  Polynomial quotient(*ring_);
  for (std::size_t k = u.size(); k-- > 0;) quotient = quotient * c + ring_->constant(u[k]);
  s = part_sine(angle, c, quotient, s);
  return part;
}

/// cos(k Pi/n) where all parts of Pi are multiples of Pi/n, by T_k modulo the minimal polynomial.
Polynomial FunctionRing::cosine_of_pi(const cln::cl_I& times) {
  const Polynomial parts = ring_->constant(cln::cl_I(pi_parts_));
  std::size_t index = generators_.size();
  if (find(Kind::function, parts, kCosineOfPi, &index) == nullptr) {
    const ex angle = GiNaC::Pi / GiNaC::numeric(static_cast<long>(pi_parts_));
    generator(Kind::function, GiNaC::cos(angle), parts, kCosineOfPi,
              [&](const Polynomial&) { return Polynomial(*ring_); });
    index = generators_.size() - 1;
    const std::vector<cln::cl_I> minimal = minimal_polynomial_of_cosine(2 * pi_parts_);
    cln::cl_RA power = cln::expt(cln::cl_RA(2), static_cast<int>(minimal.size()) - 1);
    for (std::size_t k = 0; k + 1 < minimal.size(); ++k) {
      generators_[index].relation.push_back(ring_->constant(-minimal[k] / power));
      power = power / 2;
    }
  }
  const Polynomial c = ring_->variable(symbols_.size() + index);
  // cos is even, with the period 2 Pi.
  cln::cl_I k = cln::mod(times, cln::cl_I(2 * pi_parts_));
  if (k > cln::cl_I(pi_parts_)) k = cln::cl_I(2 * pi_parts_) - k;
  Polynomial before = c, now = ring_->constant(1);  // T_(-1) and T_0
  for (; k > 0; k = k - 1) {
    Polynomial next = reduced_power((c * now).scaled(2), index) - before;
    before = std::move(now);
    now = std::move(next);
  }
  return now;
}

/// Sine and cosine of a rational multiple of Pi: GiNaC knows those of twelfths, and all others are
/// in one field, generated by the cosine of Pi over an even number (sin x = cos(Pi/2 - x)).
std::optional<std::pair<Polynomial, Polynomial>> FunctionRing::sine_cosine_of_pi(
    const cln::cl_RA& part) {
  const cln::cl_I twelve = 12;
  const cln::cl_I denominator = cln::denominator(part);
  if (pi_parts_ == 0 && cln::mod(twelve, denominator) == 0) {
    const ex angle = GiNaC::numeric(part) * GiNaC::Pi;
    return std::pair(convert(GiNaC::sin(angle)), convert(GiNaC::cos(angle)));
  }
  const cln::cl_I finer =
      cln::lcm(cln::lcm(denominator, cln::cl_I(pi_parts_ == 0 ? 2 : pi_parts_)), cln::cl_I(2));
  if (finer > cln::cl_I(kMostPiParts)) return std::nullopt;
  const unsigned long parts = machine_word(finer);
  if (n_euler_phi(2 * parts) / 2 > kMostPiDegree) return std::nullopt;
  if (parts != pi_parts_) {
    pi_parts_ = parts;
    throw Full{};  // roots of numbers may be in the field now
  }
  const cln::cl_I times = cln::numerator(part * cln::cl_RA(finer));
  return std::pair(cosine_of_pi(cln::cl_I(pi_parts_ / 2) - times), cosine_of_pi(times));
}

/// sqrt(p) where it is in the field of the parts of Pi: 2 cos(Pi/4), or Gauss's sum of (a/p)
/// exp(2 Pi I a/p), which is sqrt(p) for p = 1 mod 4 and I sqrt(p) for p = 3 mod 4.
std::optional<Polynomial> FunctionRing::root_by_pi(unsigned long prime) {
  if (pi_parts_ == 0) return std::nullopt;
  if (prime == 2) {
    if (pi_parts_ % 4 != 0) return std::nullopt;
    return cosine_of_pi(cln::cl_I(pi_parts_ / 4)).scaled(2);
  }
  if (pi_parts_ % prime != 0) return std::nullopt;
  Polynomial sum(*ring_);
  for (unsigned long a = 1; a < prime; ++a) {
    const cln::cl_I angle = cln::cl_I(2 * a * (pi_parts_ / prime));
    const bool real = prime % 4 == 1;
    sum += cosine_of_pi(real ? angle : cln::cl_I(pi_parts_ / 2) - angle)
               .scaled(n_jacobi(static_cast<mp_limb_signed_t>(a), prime));
  }
  return sum;
}

/// The root of a rational multiple of the square of a cosine of a part of Pi, as of sin(Pi/5)^2 =
/// (5 - sqrt(5))/8: the multiple of that cosine which is positive, as balls certify.
std::optional<Polynomial> FunctionRing::square_root_by_pi(const Polynomial& top,
                                                          const Polynomial& bottom) {
  if (pi_parts_ == 0 || !bottom.is_constant() || top.is_constant()) return std::nullopt;
  std::size_t index = 0;
  const Polynomial parts = ring_->constant(cln::cl_I(pi_parts_));
  if (find(Kind::function, parts, kCosineOfPi, &index) == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < ring_->size(); ++i)
    if (i != symbols_.size() + index && top.uses(i)) return std::nullopt;
  const Polynomial p = reduced(top.scaled(1 / bottom.term_list()[0].first));
  for (unsigned long k = 0; k < pi_parts_; ++k) {
    const Polynomial c = cosine_of_pi(cln::cl_I(k));
    const Polynomial square = reduced(c * c);
    if (square.is_zero()) continue;
    const cln::cl_RA ratio = p.content() / square.content();
    if (cln::minusp(ratio) || !(p == square.scaled(ratio))) continue;
    const std::optional<int> sign =
        c.is_constant() ? (cln::minusp(c.content()) ? -1 : 1) : sign_of_number(c);
    if (!sign) continue;
    return checked_product(number_root(ratio, 2), c.scaled(*sign));
  }
  return std::nullopt;
}

}  // namespace casimir
