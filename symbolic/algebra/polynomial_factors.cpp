// Factors and greatest common divisors of polynomials.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/factor_memory.hpp"
#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace {

/// FLINT's algorithms are dense in each variable: x^1000 + x + 1 takes it two seconds, and from
/// x^(10^9) it does not return.
void check_degree(const Polynomial& p, long most, const char* what) {
  for (std::size_t i = 0; p.terms() > 1 && i < p.ring().size(); ++i) {
    if (p.degree(i) > most)
      throw TooLarge(fmt::format("a polynomial of degree {} in one variable is too large {}",
                                 p.degree(i), what));
  }
}

/// Whether some variable x occurs in one term alone, and there without a power, while no variable
/// occurs in all terms: m*x + b, where the monomial m has no factor in common with b. So it is
/// primitive and of the degree 1 in x, hence irreducible (Gauss). FLINT would see that too, after
/// preparations that take longer than all else where polynomials are short.
bool has_lonely_variable(const Polynomial& p) {
  constexpr std::size_t kMostTerms = 100;
  if (p.terms() > kMostTerms) return false;
  std::vector<std::size_t> occurs(p.ring().size());
  std::vector<unsigned long> last(p.ring().size());
  for (const auto& [coefficient, exponents] : p.term_list()) {
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] == 0) continue;
      ++occurs[i];
      last[i] = exponents[i];
    }
  }
  bool lonely = false;
  for (std::size_t i = 0; i < occurs.size(); ++i) {
    if (occurs[i] == p.terms()) return false;
    lonely = lonely || (occurs[i] == 1 && last[i] == 1);
  }
  return lonely;
}

}  // namespace

std::vector<std::pair<Polynomial, unsigned long>> Polynomial::factors() const {
  if (terms() == 1) return monomial_factors();
  if (has_lonely_variable(*this)) {
    const cln::cl_RA number = content();
    return {{ring_->constant(number), 1}, {scaled(1 / number), 1}};
  }
  if (auto known = ring_->factor_memory().of(*this)) return *std::move(known);
  constexpr long kMostDegree = 200;
  constexpr double kMostBits = 10'000;  // at the degree of 200 some 0.2 s
  constexpr std::size_t kMostTerms = 20'000;
  check_degree(*this, kMostDegree, "to be factored");
  if (terms() > kMostTerms)
    throw TooLarge(fmt::format("a polynomial of {} terms is too large to be factored", terms()));
  if (bits() > kMostBits)
    throw TooLarge(fmt::format("a coefficient of {:.0f} bits is too large to be factored", bits()));
  // FLINT's preparations take time for every variable of the ring, also for those that do not
  // occur.
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < ring_->size(); ++i) {
    if (uses(i)) used.push_back(i);
  }
  Factors result;
  if (used.size() == ring_->size()) {
    result = own_factors();
  } else {
    const PolynomialRing small(used.size());
    std::vector<std::size_t> places(ring_->size());
    for (std::size_t k = 0; k < used.size(); ++k) places[used[k]] = k;
    for (const auto& [factor, exponent] : moved_to(small, places).own_factors())
      result.emplace_back(factor.moved_to(*ring_, used), exponent);
  }
  ring_->factor_memory().keep(*this, result);
  return result;
}

/// The same polynomial in another ring, where variable i is called places[i].
Polynomial Polynomial::moved_to(const PolynomialRing& ring,
                                const std::vector<std::size_t>& places) const {
  TermCollector terms(ring);
  std::vector<unsigned long> there(ring.size());
  for (const auto& [coefficient, exponents] : term_list()) {
    std::fill(there.begin(), there.end(), 0);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      if (exponents[i] > 0) there[places[i]] = exponents[i];
    }
    terms.add(coefficient, there);
  }
  return terms.finish();
}

std::vector<std::pair<Polynomial, unsigned long>> Polynomial::own_factors() const {
  fmpq_mpoly_factor_t factorisation;
  fmpq_mpoly_factor_init(factorisation, ring_->context());
  std::vector<std::pair<Polynomial, unsigned long>> result;
  const bool done = fmpq_mpoly_factor(factorisation, value_, ring_->context()) != 0;
  if (done) {
    Rational constant;
    fmpq_mpoly_factor_get_constant_fmpq(constant.get(), factorisation, ring_->context());
    result.emplace_back(ring_->constant(constant.number()), 1);
    for (slong i = 0; i < fmpq_mpoly_factor_length(factorisation, ring_->context()); ++i) {
      Polynomial base(*ring_);
      fmpq_mpoly_factor_get_base(base.value_, factorisation, i, ring_->context());
      result.emplace_back(std::move(base), static_cast<unsigned long>(fmpq_mpoly_factor_get_exp_si(
                                               factorisation, i, ring_->context())));
    }
  }
  fmpq_mpoly_factor_clear(factorisation, ring_->context());
  if (!done) throw std::overflow_error("a polynomial is too large to be factored");
  return result;
}

std::vector<std::pair<Polynomial, unsigned long>> Polynomial::monomial_factors() const {
  const auto [coefficient, exponents] = term_list()[0];
  std::vector<std::pair<Polynomial, unsigned long>> result;
  result.emplace_back(ring_->constant(coefficient), 1);
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] > 0) result.emplace_back(ring_->variable(i), exponents[i]);
  }
  return result;
}

Polynomial Polynomial::gcd(const Polynomial& a, const Polynomial& b) {
  constexpr long kMostDegree = 100'000;
  for (const Polynomial* p : {&a, &b})
    check_degree(*p, kMostDegree, "for a greatest common divisor");
  Polynomial result(*a.ring_);
  if (fmpq_mpoly_gcd(result.value_, a.value_, b.value_, a.ring_->context()) == 0) {
    throw std::overflow_error("polynomials are too large for their greatest common divisor");
  }
  return result;
}

}  // namespace casimir
