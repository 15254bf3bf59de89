// Roots and absolute values in a FunctionRing.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <numeric>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {

using GiNaC::ex;

/// A power of a root as a factor that its relation hides: a + b u is u (a' u^(q-1) + b) where a is
/// a' u^q. Without it x^2 + y^2 + x r would not be r (r + x).
std::pair<Polynomial, Polynomial> FunctionRing::without_roots(Polynomial p) const {
  Polynomial roots = ring_->constant(1);
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind != Kind::root || generators_[g].base.is_constant() ||
        !p.uses(symbols_.size() + g))
      continue;
    const std::vector<Polynomial> parts = p.coefficients(symbols_.size() + g);
    const unsigned long order = generators_[g].order;
    Polynomial first(*ring_);
    if (parts.size() > order || parts[0].is_zero() || !parts[0].divide(generators_[g].base, &first))
      continue;
    std::size_t least = 1;
    while (parts[least].is_zero()) ++least;
    const Polynomial u = ring_->variable(symbols_.size() + g);
    p = first * u.pow(order - least);
    for (std::size_t k = least; k < parts.size(); ++k) p += parts[k] * u.pow(k - least);
    roots *= u.pow(least);
  }
  return {std::move(p), std::move(roots)};
}

/// The factors of `p`, with (1 - sin)(1 + sin) as cos^2.
std::vector<std::pair<Polynomial, unsigned long>> FunctionRing::factors_of(
    const Polynomial& whole) const {
  const auto [p, roots] = without_roots(whole);
  auto factors = p.factors();
  if (!roots.is_constant()) {
    for (const auto& [u, exponent] : roots.factors()) {
      if (u.is_constant()) continue;
      const auto same = std::find_if(factors.begin(), factors.end(),
                                     [&u = u](const auto& factor) { return factor.first == u; });
      if (same == factors.end())
        factors.emplace_back(u, exponent);
      else
        same->second += exponent;
    }
  }
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
  if (q == 2) {
    if (const auto of_pi = square_root_by_pi(top, bottom)) return *of_pi;
  }
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
  if (even) {
    imply_divisor(bottom);
    imply_radicand(factors, false);
  }
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
      if (times % q == 0) continue;
      const auto by_pi = q == 2 && prime <= 240 ? root_by_pi(machine_word(prime)) : std::nullopt;
      const Polynomial one = by_pi ? *by_pi : plain_root(ring_->constant(prime), q);
      result = checked_product(result, power(one, times % q));
    }
  }
  return result;
}

/// Roots of one radicand are powers of one generator: b^(1/2) = (b^(1/4))^2, and b^(1/3) =
/// (b^(1/6))^2 where b is not negative, as it is where an even root of it is real. Principal values
/// are exp(log(b)/q), for which that is true of any b. And the root of a root is one:
/// (b^(1/m))^(1/q) = b^(1/(m q)), for principal values since |arg b^(1/m)| <= Pi/m.
Polynomial FunctionRing::plain_root(const Polynomial& radicand, unsigned long q) {
  constexpr unsigned long kMostOrder = 720;
  if (!complex_) {
    if (const auto simpler = q == 2 ? denested(radicand) : denested_number(radicand, q))
      return *simpler;
  }
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (generators_[g].kind != Kind::root || generators_[g].order * q > kMostOrder ||
        !radicand.uses(symbols_.size() + g))
      continue;
    const unsigned long order = generators_[g].order;
    if (!complex_ && order % 2 == 1 && sign_of(generators_[g].base) <= 0) continue;
    if (radicand == ring_->variable(symbols_.size() + g))
      return plain_root(Polynomial(generators_[g].base), order * q);
  }
  if (!complex_ && q % 2 == 1 && sign_of(radicand) <= 0) return root_generator(radicand, q);
  const ex key = expression(radicand);
  auto it = std::find_if(root_orders_.begin(), root_orders_.end(),
                         [&](const auto& entry) { return entry.first.is_equal(key); });
  if (it == root_orders_.end()) {
    root_orders_.emplace_back(key, q);
    it = root_orders_.end() - 1;
  }
  const unsigned long finer = std::lcm(it->second, q);
  if (finer > kMostOrder) return root_generator(radicand, q);
  if (finer != it->second) {
    it->second = finer;
    throw Full{};
  }
  return power(root_generator(radicand, finer), finer / q);
}

Polynomial FunctionRing::root_generator(const Polynomial& radicand, unsigned long q) {
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
