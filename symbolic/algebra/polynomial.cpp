#include "symbolic/algebra/polynomial.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "symbolic/algebra/factor_memory.hpp"
#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace {

/// The exponents of all variables are added for each pair of terms.
void count_product(const Polynomial& a, const Polynomial& b) {
  WorkMeter::spend(static_cast<double>(a.terms()) * static_cast<double>(b.terms()) *
                   static_cast<double>(a.ring().size()));
}

}  // namespace

PolynomialRing::PolynomialRing(std::size_t variables)
    : size_(variables), factor_memory_(std::make_unique<FactorMemory>()) {
  fmpq_mpoly_ctx_init(context_, static_cast<slong>(variables), ORD_DEGREVLEX);
}

PolynomialRing::~PolynomialRing() {
  factor_memory_.reset();  // its polynomials need the context
  fmpq_mpoly_ctx_clear(context_);
}

Polynomial PolynomialRing::constant(const cln::cl_RA& value) const {
  Polynomial result(*this);
  Rational rational(value);
  fmpq_mpoly_set_fmpq(result.raw(), rational.get(), context_);
  return result;
}

Polynomial PolynomialRing::variable(std::size_t i) const {
  assert(i < size_);
  Polynomial result(*this);
  fmpq_mpoly_gen(result.raw(), static_cast<slong>(i), context_);
  return result;
}

Polynomial::Polynomial(const PolynomialRing& ring) : ring_(&ring) {
  fmpq_mpoly_init(value_, ring.context());
}

Polynomial::Polynomial(const Polynomial& other) : Polynomial(*other.ring_) {
  fmpq_mpoly_set(value_, other.value_, ring_->context());
}

Polynomial::Polynomial(Polynomial&& other) noexcept : Polynomial(*other.ring_) {
  fmpq_mpoly_swap(value_, other.value_, ring_->context());
}

Polynomial& Polynomial::operator=(const Polynomial& other) {
  if (this == &other) return *this;
  assert(ring_ == other.ring_);
  fmpq_mpoly_set(value_, other.value_, ring_->context());
  return *this;
}

Polynomial& Polynomial::operator=(Polynomial&& other) noexcept {
  assert(ring_ == other.ring_);
  fmpq_mpoly_swap(value_, other.value_, ring_->context());
  return *this;
}

Polynomial::~Polynomial() { fmpq_mpoly_clear(value_, ring_->context()); }

Polynomial& Polynomial::operator+=(const Polynomial& other) {
  fmpq_mpoly_add(value_, value_, other.value_, ring_->context());
  return *this;
}

Polynomial& Polynomial::operator-=(const Polynomial& other) {
  fmpq_mpoly_sub(value_, value_, other.value_, ring_->context());
  return *this;
}

Polynomial& Polynomial::operator*=(const Polynomial& other) {
  count_product(*this, other);
  fmpq_mpoly_mul(value_, value_, other.value_, ring_->context());
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  count_product(a, b);
  Polynomial result(*a.ring_);
  fmpq_mpoly_mul(result.value_, a.value_, b.value_, a.ring_->context());
  return result;
}

Polynomial Polynomial::operator-() const {
  Polynomial result(*ring_);
  fmpq_mpoly_neg(result.value_, value_, ring_->context());
  return result;
}

Polynomial Polynomial::scaled(const cln::cl_RA& factor) const {
  Polynomial result(*ring_);
  Rational rational(factor);
  fmpq_mpoly_scalar_mul_fmpq(result.value_, value_, rational.get(), ring_->context());
  return result;
}

bool operator==(const Polynomial& a, const Polynomial& b) {
  return fmpq_mpoly_equal(a.value_, b.value_, a.ring_->context()) != 0;
}

Polynomial Polynomial::pow(unsigned long exponent) const {
  Polynomial result(*ring_);
  if (fmpq_mpoly_pow_ui(result.value_, value_, exponent, ring_->context()) == 0) {
    throw std::overflow_error("a power of a polynomial is too large");
  }
  return result;
}

Polynomial Polynomial::derivative(std::size_t variable) const {
  Polynomial result(*ring_);
  fmpq_mpoly_derivative(result.value_, value_, static_cast<slong>(variable), ring_->context());
  return result;
}

bool Polynomial::is_zero() const { return fmpq_mpoly_is_zero(value_, ring_->context()) != 0; }

bool Polynomial::is_constant() const { return fmpq_mpoly_is_fmpq(value_, ring_->context()) != 0; }

std::size_t Polynomial::terms() const {
  return static_cast<std::size_t>(fmpq_mpoly_length(value_, ring_->context()));
}

long Polynomial::degree(std::size_t variable) const {
  return fmpq_mpoly_degree_si(value_, static_cast<slong>(variable), ring_->context());
}

long Polynomial::total_degree() const {
  return fmpq_mpoly_total_degree_si(value_, ring_->context());
}

std::vector<std::pair<cln::cl_RA, std::vector<unsigned long>>> Polynomial::term_list() const {
  std::vector<std::pair<cln::cl_RA, std::vector<unsigned long>>> result;
  for (std::size_t k = 0; k < terms(); ++k) {
    Rational coefficient;
    std::vector<unsigned long> exponents(ring_->size());
    fmpq_mpoly_get_term_coeff_fmpq(coefficient.get(), value_, static_cast<slong>(k),
                                   ring_->context());
    fmpq_mpoly_get_term_exp_ui(exponents.data(), value_, static_cast<slong>(k), ring_->context());
    result.emplace_back(coefficient.number(), std::move(exponents));
  }
  return result;
}

std::vector<Polynomial> Polynomial::coefficients(std::size_t variable) const {
  constexpr long kMostDegree = 1'000'000;
  if (degree(variable) > kMostDegree)
    throw TooLarge("a polynomial has more than a million coefficients in one variable");
  std::vector<Polynomial> result(static_cast<std::size_t>(std::max(degree(variable), 0L)) + 1,
                                 Polynomial(*ring_));
  const fmpz_mpoly_struct* p = value_->zpoly;
  const fmpz_mpoly_ctx_struct* context = ring_->context()->zctx;
  if (p->bits > FLINT_BITS)
    throw std::overflow_error("the exponents of a polynomial are too large");
  // The variable's field is read from, and its power divided out of, the packed exponents. The
  // terms with one power stand in the same order without it, so that they need no sorting.
  const slong words = mpoly_words_per_exp(p->bits, context->minfo);
  std::vector<ulong> one(static_cast<std::size_t>(words));
  mpoly_gen_monomial_sp(one.data(), static_cast<slong>(variable), p->bits, context->minfo);
  slong offset = 0;
  slong shift = 0;
  mpoly_gen_offset_shift_sp(&offset, &shift, static_cast<slong>(variable), p->bits, context->minfo);
  const ulong mask = ~ulong{0} >> (FLINT_BITS - p->bits);
  for (slong k = 0; k < p->length; ++k) {
    const ulong* exponents = p->exps + words * k;
    const ulong power = exponents[offset] >> shift & mask;
    fmpz_mpoly_struct* part = result[power].value_->zpoly;
    if (part->length == 0)
      fmpz_mpoly_fit_length_reset_bits(part, 1, p->bits, context);
    else
      fmpz_mpoly_fit_length(part, part->length + 1, context);
    mpoly_monomial_msub(part->exps + words * part->length, exponents, power, one.data(), words);
    fmpz_set(part->coeffs + part->length, p->coeffs + k);
    ++part->length;
  }
  for (Polynomial& part : result) {
    fmpq_set(part.value_->content, value_->content);
    fmpq_mpoly_reduce(part.value_, ring_->context());
  }
  return result;
}

Polynomial Polynomial::sum(const PolynomialRing& ring, std::vector<const Polynomial*> summands) {
  if (summands.size() == 1) return *summands[0];
  std::sort(summands.begin(), summands.end(),
            [](const Polynomial* a, const Polynomial* b) { return a->terms() < b->terms(); });
  std::vector<Polynomial> pairs;
  pairs.reserve((summands.size() + 1) / 2);
  for (std::size_t i = 0; i + 1 < summands.size(); i += 2) {
    pairs.emplace_back(ring);
    fmpq_mpoly_add(pairs.back().value_, summands[i]->value_, summands[i + 1]->value_,
                   ring.context());
  }
  if (summands.size() % 2 == 1) pairs.push_back(*summands.back());
  return sum(ring, std::move(pairs));
}

Polynomial Polynomial::sum(const PolynomialRing& ring, std::vector<Polynomial> summands) {
  if (summands.empty()) return Polynomial(ring);
  // Each round adds neighbours and leaves the sums in front.
  for (std::size_t size = summands.size(); size > 1; size = (size + 1) / 2) {
    for (std::size_t i = 0; 2 * i + 1 < size; ++i) {
      summands[2 * i] += summands[2 * i + 1];
      if (i > 0) std::swap(summands[i], summands[2 * i]);
    }
    if (size % 2 == 1) std::swap(summands[size / 2], summands[size - 1]);
  }
  return std::move(summands[0]);
}

std::optional<Polynomial::LinearForm> Polynomial::linear_form() const {
  const fmpz_mpoly_struct* p = value_->zpoly;
  const auto small = [](const fmpz_t number) { return fmpz_bits(number) < 31; };
  LinearForm form;
  form.coefficients.reserve(static_cast<std::size_t>(p->length));
  if (p->length == 0) return form;
  const fmpz* numerator = fmpq_numref(value_->content);
  if (!small(numerator) || !small(fmpq_denref(value_->content))) return std::nullopt;
  form.denominator = fmpz_get_si(fmpq_denref(value_->content));
  std::vector<unsigned long> exponents(ring_->size());
  for (slong k = 0; k < p->length; ++k) {
    fmpz_mpoly_get_term_exp_ui(exponents.data(), p, k, ring_->context()->zctx);
    const auto one =
        std::find_if(exponents.begin(), exponents.end(), [](auto e) { return e != 0; });
    const bool linear = one != exponents.end() && *one == 1 &&
                        std::all_of(one + 1, exponents.end(), [](auto e) { return e == 0; });
    if (!linear || !small(p->coeffs + k)) return std::nullopt;
    const long value = fmpz_get_si(p->coeffs + k) * fmpz_get_si(numerator);
    if (std::labs(value) >> 31 != 0) return std::nullopt;
    form.coefficients.emplace_back(static_cast<std::size_t>(one - exponents.begin()), value);
  }
  return form;
}

cln::cl_RA Polynomial::evaluate(const std::vector<cln::cl_RA>& point) const {
  assert(point.size() == ring_->size());
  std::vector<Rational> values(point.size());
  std::vector<fmpq*> pointers;
  for (std::size_t i = 0; i < point.size(); ++i) {
    to_fmpz(fmpq_numref(values[i].get()), cln::numerator(point[i]));
    to_fmpz(fmpq_denref(values[i].get()), cln::denominator(point[i]));
    pointers.push_back(values[i].get());
  }
  Rational result;
  if (fmpq_mpoly_evaluate_all_fmpq(result.get(), value_, pointers.data(), ring_->context()) == 0) {
    throw std::overflow_error("the value of a polynomial is too large");
  }
  return result.number();
}

cln::cl_RA Polynomial::content() const {
  Rational result;
  if (!is_zero()) {
    fmpq_mpoly_content(result.get(), value_, ring_->context());
    Rational leading;
    fmpq_mpoly_get_term_coeff_fmpq(leading.get(), value_, 0, ring_->context());
    if (fmpq_sgn(leading.get()) < 0) fmpq_neg(result.get(), result.get());
  }
  return result.number();
}

double Polynomial::bits() const {
  if (is_zero()) return 0;
  const fmpq* content = value_->content;
  return static_cast<double>(fmpz_bits(fmpq_numref(content))) +
         static_cast<double>(fmpz_bits(fmpq_denref(content))) +
         std::abs(
             static_cast<double>(_fmpz_vec_max_bits(value_->zpoly->coeffs, value_->zpoly->length)));
}

bool Polynomial::divide(const Polynomial& divisor, Polynomial* quotient) const {
  return fmpq_mpoly_divides(quotient->value_, value_, divisor.value_, ring_->context()) != 0;
}

Polynomial Polynomial::remainder(const std::vector<Polynomial>& divisors,
                                 std::vector<Polynomial>* quotients) const {
  Polynomial rest(*ring_);
  quotients->assign(divisors.size(), Polynomial(*ring_));
  std::vector<fmpq_mpoly_struct*> q;
  std::vector<fmpq_mpoly_struct*> d;
  for (std::size_t i = 0; i < divisors.size(); ++i) {
    q.push_back((*quotients)[i].value_);
    // FLINT's signature lacks a const; the divisors are only read.
    d.push_back(const_cast<fmpq_mpoly_struct*>(divisors[i].value_));
  }
  fmpq_mpoly_divrem_ideal(q.data(), rest.value_, value_, d.data(), static_cast<slong>(d.size()),
                          ring_->context());
  return rest;
}

Polynomial in_ring(const Polynomial& p, const PolynomialRing& ring) {
  TermCollector collector(ring);
  for (auto [number, exponents] : p.term_list()) {
    exponents.resize(ring.size(), 0);
    collector.add(number, exponents);
  }
  return collector.finish();
}

}  // namespace casimir
