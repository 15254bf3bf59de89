#include "symbolic/functions/convert/exponentials.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/convert/denominators.hpp"
#include "symbolic/functions/function_factors.hpp"

namespace casimir::functions {

using GiNaC::ex;

/// log f where f is one generator: log exp v = v, log|b| = log(b^2)/2, and log(b^(1/q)) = log(b)/q
/// for even q, since f is real and not zero where its logarithm, or that of its square, is, so that
/// b > 0. An odd root of b < 0 has no logarithm on one convention, and log|b|/q on the other.
std::optional<Polynomial> Exponentials::logarithm_of_generator(const Polynomial& f) {
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    if (!(f == table_.variable(g))) continue;
    // By value: more generators are made.
    const Generator own = table_.generators()[g];
    if (own.kind == Kind::exponential) return own.base;
    const bool root =
        own.kind == Kind::root && (own.order % 2 == 0 || signs_.sign_of(own.base) > 0);
    if (!root && own.kind != Kind::absolute) return std::nullopt;
    return logarithm(GiNaC::log(table_.expression(own.base)), own.base)
        .scaled(1 / cln::cl_RA(cln::cl_I(own.order)));
  }
  return std::nullopt;
}

/// log|p| = log|c| - log|b| where a logarithm of b is known and p*b is a number c: then b vanishes
/// nowhere that p does not, and both have values at the same points. So log(w - x) is
/// -log(w + x) for w = sqrt(x^2 + 1).
/// \param tag  of log(p) or log|p|; the former has a value where p > 0, as log(b) where b > 0
std::optional<Polynomial> Exponentials::logarithm_of_reciprocal(const Polynomial& p,
                                                                unsigned long tag) {
  if (table_.is_complex() || p.is_constant()) return std::nullopt;
  for (std::size_t g = 0; g < table_.generators().size(); ++g) {
    const Generator& own = table_.generators()[g];
    const bool is_logarithm =
        own.kind == Kind::function &&
        (own.order == kLogOfAbsolute || (own.order == kLogarithm && tag == kLogarithm));
    if (!is_logarithm || own.base.is_constant()) continue;
    const auto [top, bottom] = table_.lowest_terms(table_.checked_product(p, own.base));
    if (!top.is_constant() || !bottom.is_constant() || top.is_zero()) continue;
    const cln::cl_RA number = cln::abs(top.term_list()[0].first / bottom.term_list()[0].first);
    const Polynomial of_number =
        logarithm(GiNaC::log(ex(GiNaC::numeric(number))), table_.ring().constant(number));
    return of_number - table_.variable(g);
  }
  return std::nullopt;
}

/// log(p) as a sum of logarithms of primes and of irreducible factors, each positive where that is
/// known, so that log(x*y) = log(x) + log(y).
Polynomial Exponentials::logarithm(const ex& whole, const Polynomial& p) {
  const Polynomial one = table_.ring().constant(1);
  const auto generator_of = [&](const Polynomial& base, const ex& value, unsigned long tag) {
    std::size_t index = 0;
    if (table_.find(Kind::function, base, tag, &index) != nullptr) return table_.variable(index);
    if (const auto reciprocal = logarithm_of_reciprocal(base, tag)) return *reciprocal;
    const Polynomial over = inverse_of(table_, base);
    return table_.generator(Kind::function, value, base, tag,
                            [&](const Polynomial& slope) { return slope * over; });
  };
  if (table_.is_complex()) return generator_of(p, whole, kLogarithm);
  const auto [unreduced, bottom] = table_.fraction(p);
  const Polynomial top = table_.numerator(unreduced);
  if (top.is_zero()) throw NoValue("the logarithm of an expression that is identically zero");
  auto factors = factors_of(table_, top);
  const std::size_t above = factors.size();
  for (auto& factor : factors_of(table_, bottom)) factors.push_back(std::move(factor));
  const bool negative_number =
      factors.size() == 2 && cln::minusp(factors[0].first.term_list()[0].first);
  if (negative_number) return generator_of(p, whole, kLogarithm);  // a complex constant
  signs_.imply_radicand(factors, true);
  Polynomial sum(table_.ring());
  for (std::size_t k = 0; k < factors.size(); ++k) {
    const auto& [f, exponent] = factors[k];
    const cln::cl_RA times = k < above ? cln::cl_RA(exponent) : -cln::cl_RA(exponent);
    if (const auto inner = logarithm_of_generator(f)) {
      sum += inner->scaled(times);
      continue;
    }
    if (f.is_constant()) {
      const cln::cl_RA number = cln::abs(f.term_list()[0].first);
      for (const auto& [integer, sign] :
           {std::pair(cln::numerator(number), 1), std::pair(cln::denominator(number), -1)}) {
        const auto primes = prime_factors(integer);
        if (!primes) throw TooLarge("the logarithm of a number that is too large to be factored");
        for (const auto& [prime, count] : *primes) {
          const ex value = GiNaC::log(ex(GiNaC::numeric(prime)));
          sum += generator_of(table_.ring().constant(prime), value, kLogarithm)
                     .scaled(times * sign * cln::cl_RA(cln::cl_I(count)));
        }
      }
      continue;
    }
    const int sign = signs_.known_sign(f);
    const Polynomial base = sign < 0 ? -f : f;
    const ex inside = table_.expression(base);
    sum += (sign != 0 ? generator_of(base, GiNaC::log(inside), kLogarithm)
                      : generator_of(base, GiNaC::log(inside * inside) / 2, kLogOfAbsolute))
               .scaled(times);
  }
  return sum;
}

/// exp(k log x) = x^k for rational k, exp(I x) = cos(x) + I sin(x).
std::optional<Polynomial> Exponentials::special_exponential(
    const cln::cl_RA& coefficient, const std::vector<unsigned long>& monomial) {
  std::size_t i = table_.symbols().size();
  while (i < monomial.size() && monomial[i] == 0) ++i;
  if (i == monomial.size() || monomial[i] != 1) return std::nullopt;
  const Kind kind = table_.at_place(i).kind;
  Polynomial rest = table_.ring().constant(coefficient);
  for (std::size_t k = 0; k < monomial.size(); ++k) {
    if (k != i && monomial[k] > 0) rest *= table_.ring().variable(k).pow(monomial[k]);
  }
  if (kind == Kind::imaginary) {
    const auto [sine, cosine] = angles_.sine_cosine(rest);
    return cosine + table_.ring().variable(i) * sine;
  }
  const unsigned long tag = table_.at_place(i).order;
  const bool logarithm =
      kind == Kind::function && (tag == kLogarithm || tag == kLogOfAbsolute) && rest.is_constant();
  if (!logarithm || (table_.is_complex() && cln::denominator(coefficient) != 1))
    return std::nullopt;
  const cln::cl_I times = cln::numerator(coefficient);
  if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an exponent is too large");
  Polynomial argument = table_.at_place(i).base;
  if (tag == kLogOfAbsolute) argument = roots_.absolute(argument);
  const cln::cl_I denominator = cln::denominator(coefficient);
  if (denominator != 1) argument = roots_.root(argument, machine_word(denominator));
  return table_.power(cln::minusp(times) ? inverse_of(table_, argument) : argument,
                      machine_word(times));
}

Polynomial Exponentials::exponential(const Polynomial& exponent) {
  Polynomial result = table_.ring().constant(1);
  for (const auto& [coefficient, monomial] : exponent.term_list()) {
    if (const auto special = special_exponential(coefficient, monomial)) {
      result = table_.checked_product(result, *special);
      continue;
    }
    const auto [unit, times] = units_.unit_of(monomial, coefficient);
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an exponent is too large");
    std::size_t index = 0;
    Polynomial e(table_.ring());
    if (table_.find(Kind::exponential, unit, 1, &index) != nullptr) {
      e = table_.variable(index);
    } else {
      const Polynomial next = table_.next_variable();
      e = table_.generator(Kind::exponential, GiNaC::exp(table_.expression(unit)), unit, 1,
                           [&](const Polynomial& slope) { return slope * next; });
    }
    const Polynomial base = cln::minusp(times) ? inverse_of(table_, e) : e;
    result = table_.checked_product(result, table_.power(base, machine_word(times)));
  }
  return result;
}

}  // namespace casimir::functions
