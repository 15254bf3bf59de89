// Long sums of polynomials: of terms in any order, and of products.
#include <cln/integer.h>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {
namespace {

/// Multiplies the integer part and the denominator by what makes the latter a multiple of
/// `divisor`.
void make_divisible(Polynomial& p, fmpz_t denominator, const fmpz_t divisor) {
  if (fmpz_divisible(denominator, divisor)) return;
  fmpz_t common;
  fmpz_init(common);
  fmpz_lcm(common, denominator, divisor);
  fmpz_divexact(denominator, common, denominator);
  fmpz_mpoly_scalar_mul_fmpz(p.raw()->zpoly, p.raw()->zpoly, denominator, p.ring().context()->zctx);
  fmpz_swap(denominator, common);
  fmpz_clear(common);
}

/// Gives the integer part of `p` the content 1/denominator.
void set_denominator(Polynomial& p, const fmpz_t denominator) {
  fmpz_one(fmpq_numref(p.raw()->content));
  fmpz_set(fmpq_denref(p.raw()->content), denominator);
  fmpq_mpoly_reduce(p.raw(), p.ring().context());
}

}  // namespace

TermCollector::TermCollector(const PolynomialRing& ring) : sum_(ring) {
  fmpz_init(coefficient_);
  fmpz_init(term_denominator_);
  fmpz_init_set_ui(denominator_, 1);
}

TermCollector::~TermCollector() {
  fmpz_clear(coefficient_);
  fmpz_clear(term_denominator_);
  fmpz_clear(denominator_);
}

void TermCollector::add(const cln::cl_RA& coefficient,
                        const std::vector<unsigned long>& exponents) {
  if (cln::zerop(coefficient)) return;
  to_fmpz(coefficient_, cln::numerator(coefficient));
  to_fmpz(term_denominator_, cln::denominator(coefficient));
  if (!fmpz_equal(term_denominator_, denominator_)) {
    make_divisible(sum_, denominator_, term_denominator_);
    fmpz_divexact(term_denominator_, denominator_, term_denominator_);
    fmpz_mul(coefficient_, coefficient_, term_denominator_);
  }
  fmpz_mpoly_push_term_fmpz_ui(sum_.raw()->zpoly, coefficient_, exponents.data(),
                               sum_.ring().context()->zctx);
}

Polynomial TermCollector::finish() {
  if (sum_.raw()->zpoly->length > 1) {
    fmpz_mpoly_sort_terms(sum_.raw()->zpoly, sum_.ring().context()->zctx);
    fmpz_mpoly_combine_like_terms(sum_.raw()->zpoly, sum_.ring().context()->zctx);
  }
  set_denominator(sum_, denominator_);
  return std::move(sum_);
}

SumOfProducts::SumOfProducts(const PolynomialRing& ring) : sum_(ring), product_(ring) {
  fmpz_init_set_ui(denominator_, 1);
}

SumOfProducts::~SumOfProducts() { fmpz_clear(denominator_); }

void SumOfProducts::add(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return;
  WorkMeter::spend(static_cast<double>(a.terms()) * static_cast<double>(b.terms()) *
                   static_cast<double>(a.ring().size()));
  const fmpz_mpoly_ctx_struct* context = sum_.ring().context()->zctx;
  fmpq_t factor;  // of the product of the integer parts
  fmpq_init(factor);
  fmpq_mul(factor, a.raw()->content, b.raw()->content);
  make_divisible(sum_, denominator_, fmpq_denref(factor));
  fmpq_mul_fmpz(factor, factor, denominator_);
  const Polynomial& shorter = a.terms() < b.terms() ? a : b;
  const Polynomial& longer = a.terms() < b.terms() ? b : a;
  fmpz_mpoly_struct* product = product_.raw()->zpoly;
  if (fmpz_is_one(fmpq_numref(factor))) {
    fmpz_mpoly_mul(product, shorter.raw()->zpoly, longer.raw()->zpoly, context);
  } else {
    fmpz_mpoly_scalar_mul_fmpz(product, shorter.raw()->zpoly, fmpq_numref(factor), context);
    fmpz_mpoly_mul(product, product, longer.raw()->zpoly, context);
  }
  fmpq_clear(factor);
  if (sum_.raw()->zpoly->length == 0)
    fmpz_mpoly_swap(sum_.raw()->zpoly, product, context);
  else
    fmpz_mpoly_add(sum_.raw()->zpoly, sum_.raw()->zpoly, product, context);
}

Polynomial SumOfProducts::finish() {
  set_denominator(sum_, denominator_);
  fmpz_mpoly_zero(product_.raw()->zpoly, product_.ring().context()->zctx);
  return std::move(sum_);
}

}  // namespace casimir
