#include "symbolic/polynomial.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <cassert>
#include <sstream>
#include <stdexcept>

namespace casimir {
namespace {

constexpr std::size_t kWordBits = 31;

void to_fmpz(fmpz_t result, const cln::cl_I& value) {
  if (cln::integer_length(value) < kWordBits) {
    fmpz_set_si(result, cln::cl_I_to_int(value));
    return;
  }
  std::ostringstream text;
  text << value;
  fmpz_set_str(result, text.str().c_str(), 10);
}

cln::cl_I from_fmpz(const fmpz_t value) {
  if (!COEFF_IS_MPZ(*value)) return cln::cl_I(static_cast<long>(*value));
  char* text = fmpz_get_str(nullptr, 10, value);
  const cln::cl_I result = cln::cl_I(text);
  flint_free(text);
  return result;
}

/// A scoped FLINT rational.
class Rational {
 public:
  Rational() { fmpq_init(value_); }
  explicit Rational(const cln::cl_RA& value) : Rational() {
    to_fmpz(fmpq_numref(value_), cln::numerator(value));
    to_fmpz(fmpq_denref(value_), cln::denominator(value));
  }
  ~Rational() { fmpq_clear(value_); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq* get() { return value_; }
  cln::cl_RA number() const {
    return from_fmpz(fmpq_numref(value_)) / from_fmpz(fmpq_denref(value_));
  }

 private:
  fmpq_t value_;
};

}  // namespace

PolynomialRing::PolynomialRing(std::size_t variables) : size_(variables) {
  fmpq_mpoly_ctx_init(context_, static_cast<slong>(variables), ORD_DEGREVLEX);
}

PolynomialRing::~PolynomialRing() { fmpq_mpoly_ctx_clear(context_); }

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

Polynomial& Polynomial::operator=(Polynomial other) noexcept {
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
  fmpq_mpoly_mul(value_, value_, other.value_, ring_->context());
  return *this;
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
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
  std::vector<Polynomial> result(static_cast<std::size_t>(std::max(degree(variable), 0L)) + 1,
                                 Polynomial(*ring_));
  std::vector<unsigned long> exponents(ring_->size());
  for (std::size_t k = 0; k < terms(); ++k) {
    Rational coefficient;
    fmpq_mpoly_get_term_coeff_fmpq(coefficient.get(), value_, static_cast<slong>(k),
                                   ring_->context());
    fmpq_mpoly_get_term_exp_ui(exponents.data(), value_, static_cast<slong>(k), ring_->context());
    const unsigned long power = std::exchange(exponents[variable], 0);
    fmpq_mpoly_push_term_fmpq_ui(result[power].value_, coefficient.get(), exponents.data(),
                                 ring_->context());
  }
  for (Polynomial& p : result) fmpq_mpoly_sort_terms(p.value_, ring_->context());
  return result;
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

std::vector<std::pair<Polynomial, unsigned long>> Polynomial::factors() const {
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

Polynomial Polynomial::gcd(const Polynomial& a, const Polynomial& b) {
  Polynomial result(*a.ring_);
  if (fmpq_mpoly_gcd(result.value_, a.value_, b.value_, a.ring_->context()) == 0) {
    throw std::overflow_error("polynomials are too large for their greatest common divisor");
  }
  return result;
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

}  // namespace casimir
