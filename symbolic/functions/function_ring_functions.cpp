// Angles, exponentials, logarithms and inverse functions in a FunctionRing.
#include <cln/integer.h>
#include <cln/rational.h>

#include <algorithm>

#include "symbolic/algebra/integer_factors.hpp"
#include "symbolic/algebra/machine_word.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr long kMaxMultiple = 64;

}  // namespace

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

/// The generators sin(unit) and cos(unit), which stand side by side.
std::pair<Polynomial, Polynomial> FunctionRing::plain_sine_cosine(const Polynomial& unit) {
  std::size_t index = 0;
  if (find(Kind::sine, unit, 1, &index) == nullptr) {
    index = generators_.size();
    if (generators_.size() + 2 > capacity_) grow();
    const Polynomial s = ring_->variable(symbols_.size() + index);
    const Polynomial c = ring_->variable(symbols_.size() + index + 1);
    const ex angle = expression(unit);
    const std::vector<Polynomial> unit_slopes = slopes(unit);
    const double size = 1 + expression_size(unit);
    Generator sine{Kind::sine, GiNaC::sin(angle), unit, 1, {}, size};
    // The relation c^2 = 1 - s^2 is stored as the "radicand" of c.
    Generator cosine{Kind::cosine, GiNaC::cos(angle), ring_->constant(1) - s * s, 2, {}, size};
    for (const Polynomial& slope : unit_slopes) {
      sine.derivatives.push_back(c * slope);
      cosine.derivatives.push_back(-(s * slope));
    }
    generators_.push_back(std::move(sine));
    generators_.push_back(std::move(cosine));
  }
  return {ring_->variable(symbols_.size() + index), ring_->variable(symbols_.size() + index + 1)};
}

std::pair<Polynomial, Polynomial> FunctionRing::sine_cosine(const Polynomial& angle) {
  Polynomial s(*ring_);
  Polynomial c = ring_->constant(1);
  for (const auto& [coefficient, monomial] : angle.term_list()) {
    auto part = algebraic_sine_cosine(coefficient, monomial);
    if (!part) {
      const auto [unit, count] = unit_of(monomial, coefficient);
      auto [sine, cosine] = plain_sine_cosine(unit);
      part = PartOfAngle{std::move(sine), std::move(cosine), count};
    }
    auto& [s1, c1, times] = *part;
    if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an angle is too large");
    if (cln::minusp(times)) s1 = -s1;
    for (unsigned long k = machine_word(times); k > 0; --k) {
      Polynomial next = checked_product(s, c1) + checked_product(c, s1);
      c = checked_product(c, c1) - checked_product(s, s1);
      s = std::move(next);
    }
  }
  return {std::move(s), std::move(c)};
}

/// log f where f is one generator: log exp v = v, log|b| = log(b^2)/2, and log(b^(1/q)) = log(b)/q
/// for even q, since f is real and not zero where its logarithm, or that of its square, is, so that
/// b > 0. An odd root of b < 0 has no logarithm on one convention, and log|b|/q on the other.
std::optional<Polynomial> FunctionRing::logarithm_of_generator(const Polynomial& f) {
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    if (!(f == ring_->variable(symbols_.size() + g))) continue;
    // By value: more generators are made.
    const Generator own = generators_[g];
    if (own.kind == Kind::exponential) return own.base;
    const bool root = own.kind == Kind::root && (own.order % 2 == 0 || sign_of(own.base) > 0);
    if (!root && own.kind != Kind::absolute) return std::nullopt;
    return logarithm(GiNaC::log(expression(own.base)), own.base)
        .scaled(1 / cln::cl_RA(cln::cl_I(own.order)));
  }
  return std::nullopt;
}

/// log|p| = log|c| - log|b| where a logarithm of b is known and p*b is a number c: then b vanishes
/// nowhere that p does not, and both have values at the same points. So log(w - x) is
/// -log(w + x) for w = sqrt(x^2 + 1).
/// \param tag  of log(p) or log|p|; the former has a value where p > 0, as log(b) where b > 0
std::optional<Polynomial> FunctionRing::logarithm_of_reciprocal(const Polynomial& p,
                                                                unsigned long tag) {
  if (complex_ || p.is_constant()) return std::nullopt;
  for (std::size_t g = 0; g < generators_.size(); ++g) {
    const Generator& own = generators_[g];
    const bool is_logarithm =
        own.kind == Kind::function &&
        (own.order == kLogOfAbsolute || (own.order == kLogarithm && tag == kLogarithm));
    if (!is_logarithm || own.base.is_constant()) continue;
    const auto [top, bottom] = lowest_terms(checked_product(p, own.base));
    if (!top.is_constant() || !bottom.is_constant() || top.is_zero()) continue;
    const cln::cl_RA number = cln::abs(top.term_list()[0].first / bottom.term_list()[0].first);
    const Polynomial of_number =
        logarithm(GiNaC::log(ex(GiNaC::numeric(number))), ring_->constant(number));
    return of_number - ring_->variable(symbols_.size() + g);
  }
  return std::nullopt;
}

/// log(p) as a sum of logarithms of primes and of irreducible factors, each positive where that is
/// known, so that log(x*y) = log(x) + log(y).
Polynomial FunctionRing::logarithm(const ex& whole, const Polynomial& p) {
  const Polynomial one = ring_->constant(1);
  const auto generator_of = [&](const Polynomial& base, const ex& value, unsigned long tag) {
    std::size_t index = 0;
    if (find(Kind::function, base, tag, &index) != nullptr)
      return ring_->variable(symbols_.size() + index);
    if (const auto reciprocal = logarithm_of_reciprocal(base, tag)) return *reciprocal;
    const Polynomial over = inverse(base);
    return generator(Kind::function, value, base, tag,
                     [&](const Polynomial& slope) { return slope * over; });
  };
  if (complex_) return generator_of(p, whole, kLogarithm);
  const auto [unreduced, bottom] = fraction(p);
  const Polynomial top = numerator(unreduced);
  if (top.is_zero()) throw ModelError("the logarithm of an expression that is identically zero");
  auto factors = factors_of(top);
  const std::size_t above = factors.size();
  for (auto& factor : factors_of(bottom)) factors.push_back(std::move(factor));
  const bool negative_number =
      factors.size() == 2 && cln::minusp(factors[0].first.term_list()[0].first);
  if (negative_number) return generator_of(p, whole, kLogarithm);  // a complex constant
  imply_radicand(factors, true);
  Polynomial sum(*ring_);
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
          sum += generator_of(ring_->constant(prime), value, kLogarithm)
                     .scaled(times * sign * cln::cl_RA(cln::cl_I(count)));
        }
      }
      continue;
    }
    const int sign = known_sign(f);
    const Polynomial base = sign < 0 ? -f : f;
    const ex inside = expression(base);
    sum += (sign != 0 ? generator_of(base, GiNaC::log(inside), kLogarithm)
                      : generator_of(base, GiNaC::log(inside * inside) / 2, kLogOfAbsolute))
               .scaled(times);
  }
  return sum;
}

/// exp(k log x) = x^k for rational k, exp(I x) = cos(x) + I sin(x).
std::optional<Polynomial> FunctionRing::special_exponential(
    const cln::cl_RA& coefficient, const std::vector<unsigned long>& monomial) {
  std::size_t i = symbols_.size();
  while (i < monomial.size() && monomial[i] == 0) ++i;
  if (i == monomial.size() || monomial[i] != 1) return std::nullopt;
  const Kind kind = generators_[i - symbols_.size()].kind;
  Polynomial rest = ring_->constant(coefficient);
  for (std::size_t k = 0; k < monomial.size(); ++k) {
    if (k != i && monomial[k] > 0) rest *= ring_->variable(k).pow(monomial[k]);
  }
  if (kind == Kind::imaginary) {
    const auto [sine, cosine] = sine_cosine(rest);
    return cosine + ring_->variable(i) * sine;
  }
  const unsigned long tag = generators_[i - symbols_.size()].order;
  const bool logarithm =
      kind == Kind::function && (tag == kLogarithm || tag == kLogOfAbsolute) && rest.is_constant();
  if (!logarithm || (complex_ && cln::denominator(coefficient) != 1)) return std::nullopt;
  const cln::cl_I times = cln::numerator(coefficient);
  if (cln::abs(times) > kMaxMultiple) throw TooLarge("a multiple of an exponent is too large");
  Polynomial argument = generators_[i - symbols_.size()].base;
  if (tag == kLogOfAbsolute) argument = absolute(argument);
  const cln::cl_I denominator = cln::denominator(coefficient);
  if (denominator != 1) argument = root(argument, machine_word(denominator));
  return power(cln::minusp(times) ? inverse(argument) : argument, machine_word(times));
}

Polynomial FunctionRing::exponential(const Polynomial& exponent) {
  Polynomial result = ring_->constant(1);
  for (const auto& [coefficient, monomial] : exponent.term_list()) {
    if (const auto special = special_exponential(coefficient, monomial)) {
      result = checked_product(result, *special);
      continue;
    }
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
    result = checked_product(result, power(base, machine_word(times)));
  }
  return result;
}

}  // namespace casimir
