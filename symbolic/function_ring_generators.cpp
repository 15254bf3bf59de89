// The generators of a FunctionRing: denominators, roots, angles, exponentials.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

#include "symbolic/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr long kMaxMultiple = 64;

}  // namespace

/// The generators 1/f of the irreducible factors f of a denominator.
Polynomial FunctionRing::inverse(const Polynomial& p) {
  const auto [top, bottom] = fraction(p);
  if (numerator(top).is_zero())
    throw ModelError("division by an expression that is identically zero");
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
    result = checked_product(result, y.pow(exponent));
  }
  return result;
}

/// The sign that the assumptions give to an irreducible polynomial, or 0.
int FunctionRing::known_sign(const Polynomial& p) const {
  for (const auto& [polynomial, sign] : signs_) {
    if (polynomial == p) return sign;
    if (polynomial == -p) return -sign;
  }
  return 0;
}

Polynomial FunctionRing::absolute(const Polynomial& p) {
  const int sign = known_sign(p);
  if (sign != 0) return sign > 0 ? p : -p;
  std::size_t index = 0;
  const Polynomial square = p * p;
  if (find(Kind::absolute, square, 2, &index) != nullptr)
    return ring_->variable(symbols_.size() + index);
  const Polynomial over = inverse(square);
  const Polynomial next =
      ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
  return generator(
      Kind::absolute, GiNaC::sqrt(expression(square)), square, 2,
      [&](const Polynomial& slope) { return (slope * next * over).scaled(cln::cl_RA(1) / 2); });
}

/// p^(1/q): over a common denominator, and with q-th powers taken out of the radicand.
Polynomial FunctionRing::root(const Polynomial& p, unsigned long q) {
  const auto [top, bottom] = fraction(p);
  if (numerator(top).is_zero()) return Polynomial(*ring_);
  const bool even = q % 2 == 0;
  // For an odd root the branch on negative numbers is a convention that nothing may rest on.
  const auto outside = [&](const Polynomial& f, unsigned long k) {
    return even && k % 2 == 1 ? absolute(f).pow(k) : f.pow(k);
  };
  Polynomial factor = ring_->constant(1);
  Polynomial radicand = ring_->constant(1);
  for (const auto& [f, exponent] : bottom.factors()) {
    if (f.is_constant()) {
      radicand = radicand.scaled(1 / f.term_list()[0].first);
      continue;
    }
    if (!even && known_sign(f) <= 0) return plain_root(p, q);
    const unsigned long k = (exponent + q - 1) / q;
    factor = checked_product(factor, inverse(outside(f, k)));
    radicand = checked_product(radicand, f.pow(k * q - exponent));
  }
  radicand = checked_product(radicand, top);
  Polynomial inside = ring_->constant(1);
  for (const auto& [f, exponent] : radicand.factors()) {
    const bool keep = f.is_constant() || (!even && known_sign(f) <= 0);
    inside = checked_product(inside, keep ? f.pow(exponent) : f.pow(exponent % q));
    if (!keep && exponent >= q) factor = checked_product(factor, outside(f, exponent / q));
  }
  // The positive constant factor has a root of its own, so that sqrt(2 x) = sqrt(2) sqrt(x).
  const cln::cl_RA content = cln::abs(inside.content());
  factor = checked_product(factor, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == ring_->constant(1) ? factor : checked_product(factor, plain_root(inside, q));
}

/// r^(1/q) for r > 0, by roots of primes: so that sqrt(6) = sqrt(2) sqrt(3).
Polynomial FunctionRing::number_root(const cln::cl_RA& r, unsigned long q) {
  const cln::cl_I denominator = cln::denominator(r);
  cln::cl_I rest = cln::numerator(r) * cln::expt_pos(denominator, cln::cl_I(q - 1));
  Polynomial result = ring_->constant(1 / cln::cl_RA(denominator));
  const auto take = [&](const cln::cl_I& p, unsigned long times) {
    result = result.scaled(cln::expt(p, cln::cl_I(times / q)));
    if (times % q != 0)
      result = checked_product(result, plain_root(ring_->constant(p), q).pow(times % q));
  };
  constexpr long kTrialDivisors = 2000;
  for (long p = 2; p < kTrialDivisors && rest > 1; ++p) {
    unsigned long times = 0;
    for (; cln::zerop(cln::mod(rest, p)); ++times) rest = cln::exquo(rest, cln::cl_I(p));
    if (times > 0) take(p, times);
  }
  cln::cl_I whole;
  if (cln::rootp(rest, static_cast<unsigned>(q), &whole)) return result.scaled(whole);
  take(rest, 1);
  return result;
}

Polynomial FunctionRing::plain_root(const Polynomial& radicand, unsigned long q) {
  std::size_t index = 0;
  if (find(Kind::root, radicand, q, &index) != nullptr)
    return ring_->variable(symbols_.size() + index);
  const Polynomial over = radicand.is_constant() ? radicand : inverse(radicand);
  const Polynomial next =
      ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
  return generator(Kind::root,
                   GiNaC::pow(expression(radicand), GiNaC::numeric(1, static_cast<long>(q))),
                   radicand, q, [&](const Polynomial& slope) {
                     return (slope * next * over).scaled(cln::cl_RA(1) / static_cast<long>(q));
                   });
}

/// The unit m/L of a monomial m in an angle or exponent, and how often the term contains it.
std::pair<Polynomial, cln::cl_I> FunctionRing::unit_of(const std::vector<unsigned long>& monomial,
                                                       const cln::cl_RA& coefficient) {
  Polynomial m = ring_->constant(1);
  for (std::size_t i = 0; i < monomial.size(); ++i) {
    if (monomial[i] > 0) m *= ring_->variable(i).pow(monomial[i]);
  }
  const ex key = expression(m);
  auto it = std::find_if(units_.begin(), units_.end(),
                         [&](const auto& unit) { return unit.first.is_equal(key); });
  if (it == units_.end()) {
    units_.emplace_back(key, cln::denominator(coefficient));
    it = units_.end() - 1;
  }
  const cln::cl_I finer = cln::lcm(it->second, cln::denominator(coefficient));
  if (finer != it->second) {
    it->second = finer;
    throw Full{};
  }
  const cln::cl_RA times = coefficient * finer;
  return {m.scaled(1 / cln::cl_RA(finer)), cln::numerator(times)};
}

std::pair<Polynomial, Polynomial> FunctionRing::sine_cosine(const Polynomial& angle) {
  Polynomial s(*ring_);
  Polynomial c = ring_->constant(1);
  for (const auto& [coefficient, monomial] : angle.term_list()) {
    const auto [unit, times] = unit_of(monomial, coefficient);
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an angle is too large");
    const ex angle_value = expression(unit);
    std::size_t index = 0;
    Polynomial s1(*ring_);
    Polynomial c1(*ring_);
    if (find(Kind::sine, unit, 1, &index) != nullptr) {
      s1 = ring_->variable(symbols_.size() + index);
      c1 = ring_->variable(symbols_.size() + index + 1);
    } else {
      if (generators_.size() + 2 > capacity_) grow();
      s1 = ring_->variable(symbols_.size() + generators_.size());
      c1 = ring_->variable(symbols_.size() + generators_.size() + 1);
      const std::vector<Polynomial> unit_slopes = slopes(unit);
      Generator sine{Kind::sine, GiNaC::sin(angle_value), unit, 1, {}};
      // The relation c^2 = 1 - s^2 is stored as the "radicand" of c.
      Generator cosine{Kind::cosine, GiNaC::cos(angle_value), ring_->constant(1) - s1 * s1, 2, {}};
      for (const Polynomial& slope : unit_slopes) {
        sine.derivatives.push_back(c1 * slope);
        cosine.derivatives.push_back(-(s1 * slope));
      }
      generators_.push_back(std::move(sine));
      generators_.push_back(std::move(cosine));
    }
    if (cln::minusp(times)) s1 = -s1;
    for (long k = cln::cl_I_to_long(cln::abs(times)); k > 0; --k) {
      Polynomial next = s * c1 + c * s1;
      c = c * c1 - s * s1;
      s = std::move(next);
    }
  }
  return {std::move(s), std::move(c)};
}

Polynomial FunctionRing::exponential(const Polynomial& exponent) {
  Polynomial result = ring_->constant(1);
  for (const auto& [coefficient, monomial] : exponent.term_list()) {
    const auto [unit, times] = unit_of(monomial, coefficient);
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an exponent is too large");
    std::size_t index = 0;
    Polynomial e(*ring_);
    if (find(Kind::exponential, unit, 1, &index) != nullptr) {
      e = ring_->variable(symbols_.size() + index);
    } else {
      const Polynomial next =
          ring_->variable(std::min(symbols_.size() + generators_.size(), ring_->size() - 1));
      e = generator(Kind::exponential, GiNaC::exp(expression(unit)), unit, 1,
                    [&](const Polynomial& slope) { return slope * next; });
    }
    const Polynomial base = cln::minusp(times) ? inverse(e) : e;
    result = checked_product(result, base.pow(cln::cl_I_to_ulong(cln::abs(times))));
  }
  return result;
}

}  // namespace casimir
