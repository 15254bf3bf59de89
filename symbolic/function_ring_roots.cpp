// Roots and absolute values in a FunctionRing.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

#include "symbolic/function_ring.hpp"
#include "symbolic/integer_factors.hpp"

namespace casimir {

/// The factors of `p`, with (1 - sin)(1 + sin) as cos^2.
std::vector<std::pair<Polynomial, unsigned long>> FunctionRing::factors_of(
    const Polynomial& p) const {
  auto factors = p.factors();
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind != Kind::sine) continue;
    const Polynomial s = ring_->variable(symbols_.size() + g);
    const Polynomial one = ring_->constant(1);
    const auto find_factor = [&](const Polynomial& f) {
      return std::find_if(factors.begin(), factors.end(),
                          [&](const auto& factor) { return factor.first == f; });
    };
    const auto minus = find_factor(s - one);
    const auto plus = find_factor(s + one);
    if (minus == factors.end() || plus == factors.end()) continue;
    // (s - 1)(s + 1) = -c^2; the constant factor stands first.
    const unsigned long times = std::min(minus->second, plus->second);
    minus->second -= times;
    plus->second -= times;
    if (times % 2 == 1) factors.front().first = -factors.front().first;
    factors.emplace_back(ring_->variable(symbols_.size() + g + 1), 2 * times);
  }
  std::erase_if(factors, [](const auto& factor) { return factor.second == 0; });
  return factors;
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
  const auto [unreduced, bottom] = fraction(p);
  const Polynomial top = numerator(unreduced);  // a sin^2 + a cos^2 is a
  if (top.is_zero()) return Polynomial(*ring_);
  if (complex_) return complex_root(p, q);
  const bool even = q % 2 == 0;
  // For an odd root the branch on negative numbers is a convention that nothing may rest on.
  const auto outside = [&](const Polynomial& f, unsigned long k) {
    return power(even && k % 2 == 1 ? absolute(f) : f, k);
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
    radicand = checked_product(radicand, power(f, k * q - exponent));
  }
  radicand = checked_product(radicand, top);
  const auto factors = factors_of(radicand);
  if (even) imply_radicand(factors, false);
  Polynomial inside = ring_->constant(1);
  bool negative = false;
  for (const auto& [f, exponent] : factors) {
    const int sign = known_sign(f);
    const bool keep = f.is_constant() || (!even && sign <= 0);
    if (!keep && exponent >= q) factor = checked_product(factor, outside(f, exponent / q));
    const unsigned long rest = keep ? exponent : exponent % q;
    if (keep || sign == 0) {
      inside = checked_product(inside, power(f, rest));
    } else if (rest > 0) {
      // The root of a positive factor is a function of its own, so that sqrt(a b) = sqrt(a)
      // sqrt(b).
      factor = checked_product(factor, power(plain_root(sign > 0 ? f : -f, q), rest));
      if (sign < 0 && rest % 2 == 1) negative = !negative;
    }
  }
  if (negative) inside = -inside;
  // The positive constant factor has a root of its own, so that sqrt(2 x) = sqrt(2) sqrt(x).
  const cln::cl_RA content = cln::abs(inside.content());
  factor = checked_product(factor, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == ring_->constant(1) ? factor : checked_product(factor, plain_root(inside, q));
}

/// The principal value, where nothing says that the root is real: (c z)^(1/q) = c^(1/q) z^(1/q) for
/// c >= 0 and no other c, as sqrt(1/x) and 1/sqrt(x) show for x = -1.
Polynomial FunctionRing::complex_root(const Polynomial& p, unsigned long q) {
  const auto [top, bottom] = fraction(p);
  Polynomial outside = ring_->constant(1);
  Polynomial inside = ring_->constant(1);
  for (const auto& [f, exponent] : bottom.factors()) {
    if (!f.is_constant() && (known_sign(f) <= 0 || !is_real_everywhere(f))) return plain_root(p, q);
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) return plain_root(p, q);
      outside = checked_product(outside, number_root(1 / cln::cl_RA(f.term_list()[0].first), q));
      continue;
    }
    const unsigned long k = (exponent + q - 1) / q;
    outside = checked_product(outside, inverse(power(f, k)));
    if (k * q > exponent)
      outside = checked_product(outside, power(plain_root(f, q), k * q - exponent));
  }
  for (const auto& [f, exponent] : top.factors()) {
    if (f.is_constant()) {
      inside = checked_product(inside, f);
      continue;
    }
    const bool real = is_real_everywhere(f);
    const bool positive = real && known_sign(f) > 0;
    const unsigned long whole = positive || (real && q % 2 == 0) ? exponent / q : 0;
    if (whole > 0)
      outside =
          checked_product(outside, power(!positive && whole % 2 == 1 ? absolute(f) : f, whole));
    const unsigned long rest = exponent - whole * q;
    if (rest == 0) continue;
    if (positive)
      outside = checked_product(outside, power(plain_root(f, q), rest));
    else
      inside = checked_product(inside, power(f, rest));
  }
  const cln::cl_RA content = cln::abs(inside.content());
  outside = checked_product(outside, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == ring_->constant(1) ? outside : checked_product(outside, plain_root(inside, q));
}

/// r^(1/q) for r > 0, by roots of primes: so that sqrt(6) = sqrt(2) sqrt(3).
Polynomial FunctionRing::number_root(const cln::cl_RA& r, unsigned long q) {
  Polynomial result = ring_->constant(1 / cln::cl_RA(cln::denominator(r)));
  // 1/d is d^(q - 1) in the radicand, over d.
  for (const auto& [number, copies] :
       {std::pair(cln::numerator(r), 1UL), std::pair(cln::denominator(r), q - 1)}) {
    const auto factors = prime_factors(number);
    if (!factors) throw TooLarge("the root of a number that is too large to be factored");
    for (const auto& [prime, multiplicity] : *factors) {
      const unsigned long times = multiplicity * copies;
      result = result.scaled(cln::expt(prime, cln::cl_I(times / q)));
      if (times % q != 0)
        result = checked_product(result, power(plain_root(ring_->constant(prime), q), times % q));
    }
  }
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

}  // namespace casimir
