#include "symbolic/discrete/plane_factors.hpp"

#include <flint/nmod_mpoly_factor.h>

#include <algorithm>

namespace casimir::discrete {

/// FLINT's polynomials of a and b, and what they are factored to.
struct PlaneFactors::Factors {
  explicit Factors(Element prime) {
    nmod_mpoly_ctx_init(context, 2, ORD_LEX, prime);
    nmod_mpoly_factor_init(list, context);
  }
  ~Factors() {
    nmod_mpoly_factor_clear(list, context);
    nmod_mpoly_ctx_clear(context);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  nmod_mpoly_ctx_t context;
  nmod_mpoly_factor_t list;
};

namespace {

void push_term(nmod_mpoly_t q, Element coefficient, long of_a, long of_b,
               const nmod_mpoly_ctx_t context) {
  const ulong exponents[] = {static_cast<ulong>(of_a), static_cast<ulong>(of_b)};
  nmod_mpoly_push_term_ui_ui(q, coefficient, exponents, context);
}

}  // namespace

/// The part of degree k in a and b is a^k times a polynomial of degree k in the slope.
std::optional<PlaneFactors> PlaneFactors::from_lines(const std::vector<OnLine>& lines,
                                                     Element prime) {
  const PrimeField field(prime);
  long degree = 0;
  std::vector<Element> slopes, scales;
  for (const OnLine& line : lines) {
    const nmod_poly_struct* p = line.polynomial.raw();
    const Element constant = nmod_poly_get_coeff_ui(p, 0);
    if (constant == 0) return std::nullopt;
    degree = std::max(degree, line.polynomial.degree());
    slopes.push_back(line.slope);
    scales.push_back(field.inverse(constant));
  }
  if (static_cast<long>(lines.size()) <= degree) return std::nullopt;
  auto factors = std::make_shared<Factors>(prime);
  nmod_mpoly_t q;
  nmod_mpoly_init(q, factors->context);
  bool consistent = true;
  for (long k = 0; k <= degree && consistent; ++k) {
    std::vector<Element> values;
    for (std::size_t i = 0; i < lines.size(); ++i)
      values.push_back(field.multiply(
          scales[i], nmod_poly_get_coeff_ui(lines[i].polynomial.raw(), static_cast<slong>(k))));
    Univariate part(prime);
    nmod_poly_interpolate_nmod_vec(part.raw(), slopes.data(), values.data(),
                                   static_cast<slong>(values.size()));
    consistent = part.degree() <= k;
    for (long j = 0; j <= part.degree() && consistent; ++j)
      push_term(q, nmod_poly_get_coeff_ui(part.raw(), j), k - j, j, factors->context);
  }
  if (consistent) {
    nmod_mpoly_sort_terms(q, factors->context);
    nmod_mpoly_combine_like_terms(q, factors->context);
    consistent = nmod_mpoly_factor(factors->list, q, factors->context) != 0;
  }
  nmod_mpoly_clear(q, factors->context);
  if (!consistent) return std::nullopt;
  return PlaneFactors(std::move(factors));
}

std::size_t PlaneFactors::size() const { return static_cast<std::size_t>(factors_->list->num); }

long PlaneFactors::degree(std::size_t factor) const {
  return nmod_mpoly_total_degree_si(factors_->list->poly + factor, factors_->context);
}

unsigned long PlaneFactors::exponent(std::size_t factor) const {
  return fmpz_get_ui(factors_->list->exp + factor);
}

bool PlaneFactors::vanishes(std::size_t factor, Element a, Element b) const {
  const ulong at[] = {a, b};
  return nmod_mpoly_evaluate_all_ui(factors_->list->poly + factor, at, factors_->context) == 0;
}

}  // namespace casimir::discrete
