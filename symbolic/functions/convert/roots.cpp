#include "symbolic/functions/convert/roots.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>
#include <numeric>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/convert/denominators.hpp"
#include "symbolic/functions/function_factors.hpp"

namespace casimir::functions {

using GiNaC::ex;

Polynomial Roots::absolute(const Polynomial& p) {
  const int sign = signs_.known_sign(p);
  if (sign != 0) return sign > 0 ? p : -p;
  std::size_t index = 0;
  const Polynomial square = p * p;
  if (table_.find(Kind::absolute, square, 2, &index) != nullptr) return table_.variable(index);
  const Polynomial over = inverse_of(table_, square);
  const Polynomial next = table_.next_variable();
  return table_.generator(
      Kind::absolute, GiNaC::sqrt(table_.expression(square)), square, 2,
      [&](const Polynomial& slope) { return (slope * next * over).scaled(cln::cl_RA(1) / 2); });
}

/// p^(1/q): over a common denominator, and with q-th powers taken out of the radicand.
Polynomial Roots::root(const Polynomial& p, unsigned long q) {
  const auto [unreduced, bottom] = table_.fraction(p);
  const Polynomial top = table_.numerator(unreduced);  // a sin^2 + a cos^2 is a
  if (top.is_zero()) return Polynomial(table_.ring());
  if (table_.is_complex()) return complex_root(p, q);
  if (q == 2) {
    if (const auto of_pi = square_root_by_pi(top, bottom)) return *of_pi;
  }
  const bool even = q % 2 == 0;
  Polynomial factor = table_.ring().constant(1);
  Polynomial radicand = table_.ring().constant(1);
  for (const auto& [f, exponent] : bottom.factors()) {
    if (f.is_constant()) {
      radicand = radicand.scaled(1 / f.term_list()[0].first);
      continue;
    }
    if (!even && signs_.known_sign(f) <= 0) return plain_root(p, q);
    const unsigned long k = (exponent + q - 1) / q;
    factor = table_.checked_product(factor, inverse_of(table_, outside(f, k, q)));
    radicand = table_.checked_product(radicand, table_.power(f, k * q - exponent));
  }
  radicand = table_.checked_product(radicand, top);
  const Factors factors = factors_of(table_, radicand);
  if (even) {
    signs_.imply_divisor(bottom);
    signs_.imply_radicand(factors, false);
  }
  return real_root(std::move(factor), factors, q);
}

/// The k-th power of what stands outside a q-th root. For an odd root the branch on negative
/// numbers is a convention that nothing may rest on.
Polynomial Roots::outside(const Polynomial& f, unsigned long k, unsigned long q) {
  return table_.power(q % 2 == 0 && k % 2 == 1 ? absolute(f) : f, k);
}

/// `factor` times the root of a product.
Polynomial Roots::real_root(Polynomial factor, const Factors& factors, unsigned long q) {
  const bool even = q % 2 == 0;
  Polynomial inside = table_.ring().constant(1);
  bool negative = false;
  for (const auto& [f, exponent] : factors) {
    const int sign = signs_.known_sign(f);
    const bool keep = f.is_constant() || (!even && sign <= 0);
    if (!keep && exponent >= q)
      factor = table_.checked_product(factor, outside(f, exponent / q, q));
    const unsigned long rest = keep ? exponent : exponent % q;
    if (keep || sign == 0) {
      inside = table_.checked_product(inside, table_.power(f, rest));
    } else if (rest > 0) {
      // The root of a positive factor is a function of its own, so that sqrt(a b) = sqrt(a)
      // sqrt(b).
      factor = table_.checked_product(factor, table_.power(plain_root(sign > 0 ? f : -f, q), rest));
      if (sign < 0 && rest % 2 == 1) negative = !negative;
    }
  }
  if (negative) inside = -inside;
  // The positive constant factor has a root of its own, so that sqrt(2 x) = sqrt(2) sqrt(x).
  const cln::cl_RA content = cln::abs(inside.content());
  factor = table_.checked_product(factor, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == table_.ring().constant(1)
             ? factor
             : table_.checked_product(factor, plain_root(inside, q));
}

/// The principal value, where nothing says that the root is real: (c z)^(1/q) = c^(1/q) z^(1/q) for
/// c >= 0 and no other c, as sqrt(1/x) and 1/sqrt(x) show for x = -1.
Polynomial Roots::complex_root(const Polynomial& p, unsigned long q) {
  const auto [top, bottom] = table_.fraction(p);
  Polynomial outside = table_.ring().constant(1);
  Polynomial inside = table_.ring().constant(1);
  for (const auto& [f, exponent] : bottom.factors()) {
    if (!f.is_constant() && (signs_.known_sign(f) <= 0 || !table_.is_real_everywhere(f)))
      return plain_root(p, q);
    if (f.is_constant()) {
      if (cln::minusp(f.term_list()[0].first)) return plain_root(p, q);
      outside =
          table_.checked_product(outside, number_root(1 / cln::cl_RA(f.term_list()[0].first), q));
      continue;
    }
    const unsigned long k = (exponent + q - 1) / q;
    outside = table_.checked_product(outside, inverse_of(table_, table_.power(f, k)));
    if (k * q > exponent)
      outside = table_.checked_product(outside, table_.power(plain_root(f, q), k * q - exponent));
  }
  for (const auto& [f, exponent] : top.factors()) {
    if (f.is_constant()) {
      inside = table_.checked_product(inside, f);
      continue;
    }
    const bool real = table_.is_real_everywhere(f);
    const bool positive = real && signs_.known_sign(f) > 0;
    const unsigned long whole = positive || (real && q % 2 == 0) ? exponent / q : 0;
    if (whole > 0)
      outside = table_.checked_product(
          outside, table_.power(!positive && whole % 2 == 1 ? absolute(f) : f, whole));
    const unsigned long rest = exponent - whole * q;
    if (rest == 0) continue;
    if (positive)
      outside = table_.checked_product(outside, table_.power(plain_root(f, q), rest));
    else
      inside = table_.checked_product(inside, table_.power(f, rest));
  }
  const cln::cl_RA content = cln::abs(inside.content());
  outside = table_.checked_product(outside, number_root(content, q));
  inside = inside.scaled(1 / content);
  return inside == table_.ring().constant(1)
             ? outside
             : table_.checked_product(outside, plain_root(inside, q));
}

/// r^(1/q) for r > 0, by roots of primes: so that sqrt(6) = sqrt(2) sqrt(3).
Polynomial Roots::number_root(const cln::cl_RA& r, unsigned long q) {
  Polynomial result = table_.ring().constant(1 / cln::cl_RA(cln::denominator(r)));
  // 1/d is d^(q - 1) in the radicand, over d.
  for (const auto& [number, copies] :
       {std::pair(cln::numerator(r), 1UL), std::pair(cln::denominator(r), q - 1)}) {
    const auto factors = prime_factors(number);
    if (!factors) throw TooLarge("the root of a number that is too large to be factored");
    for (const auto& [prime, multiplicity] : *factors) {
      const unsigned long times = multiplicity * copies;
      result = result.scaled(cln::expt(prime, cln::cl_I(times / q)));
      if (times % q == 0) continue;
      const auto by_pi = q == 2 && prime <= 240 ? pi_.root(machine_word(prime)) : std::nullopt;
      const Polynomial one = by_pi ? *by_pi : plain_root(table_.ring().constant(prime), q);
      result = table_.checked_product(result, table_.power(one, times % q));
    }
  }
  return result;
}

/// Roots of one radicand are powers of one generator: b^(1/2) = (b^(1/4))^2, and b^(1/3) =
/// (b^(1/6))^2 where b is not negative, as it is where an even root of it is real. Principal values
/// are exp(log(b)/q), for which that is true of any b. And the root of a root is one:
/// (b^(1/m))^(1/q) = b^(1/(m q)), for principal values since |arg b^(1/m)| <= Pi/m.
Polynomial Roots::plain_root(const Polynomial& radicand, unsigned long q) {
  constexpr unsigned long kMostOrder = 720;
  if (!table_.is_complex()) {
    if (const auto simpler = q == 2 ? denested(radicand) : denested_number(radicand, q))
      return *simpler;
  }
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    if (table_.generators()[g].kind != Kind::root ||
        table_.generators()[g].order * q > kMostOrder || !radicand.uses(table_.place(g)))
      continue;
    const unsigned long order = table_.generators()[g].order;
    if (!table_.is_complex() && order % 2 == 1 && signs_.sign_of(table_.generators()[g].base) <= 0)
      continue;
    if (radicand == table_.variable(g))
      return plain_root(Polynomial(table_.generators()[g].base), order * q);
  }
  if (!table_.is_complex() && q % 2 == 1 && signs_.sign_of(radicand) <= 0)
    return root_generator(radicand, q);
  const ex key = table_.expression(radicand);
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
  return table_.power(root_generator(radicand, finer), finer / q);
}

Polynomial Roots::root_generator(const Polynomial& radicand, unsigned long q) {
  std::size_t index = 0;
  if (table_.find(Kind::root, radicand, q, &index) != nullptr) return table_.variable(index);
  const Polynomial over = radicand.is_constant() ? radicand : inverse_of(table_, radicand);
  const Polynomial next = table_.next_variable();
  return table_.generator(
      Kind::root, GiNaC::pow(table_.expression(radicand), GiNaC::numeric(1, static_cast<long>(q))),
      radicand, q, [&](const Polynomial& slope) {
        return (slope * next * over).scaled(cln::cl_RA(1) / static_cast<long>(q));
      });
}

/// The root of a rational multiple of the square of a cosine of a part of Pi, as of sin(Pi/5)^2 =
/// (5 - sqrt(5))/8: the multiple of that cosine which is positive, as balls certify.
std::optional<Polynomial> Roots::square_root_by_pi(const Polynomial& top,
                                                   const Polynomial& bottom) {
  if (pi_.parts() == 0 || !bottom.is_constant() || top.is_constant()) return std::nullopt;
  std::size_t index = 0;
  const Polynomial parts = table_.ring().constant(cln::cl_I(pi_.parts()));
  if (table_.find(Kind::function, parts, kCosineOfPi, &index) == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < table_.ring().size(); ++i)
    if (i != table_.place(index) && top.uses(i)) return std::nullopt;
  const Polynomial p = table_.reduced(top.scaled(1 / bottom.term_list()[0].first));
  for (unsigned long k = 0; k < pi_.parts(); ++k) {
    const Polynomial c = pi_.cosine(cln::cl_I(k));
    const Polynomial square = table_.reduced(c * c);
    if (square.is_zero()) continue;
    const cln::cl_RA ratio = p.content() / square.content();
    if (cln::minusp(ratio) || !(p == square.scaled(ratio))) continue;
    const std::optional<int> sign =
        c.is_constant() ? (cln::minusp(c.content()) ? -1 : 1) : signs_.sign_of_number(c);
    if (!sign) continue;
    return table_.checked_product(number_root(ratio, 2), c.scaled(*sign));
  }
  return std::nullopt;
}

}  // namespace casimir::functions
