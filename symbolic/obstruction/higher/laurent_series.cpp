#include "symbolic/obstruction/higher/laurent_series.hpp"

#include <algorithm>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// Terms of the inverse of a series whose coefficients are all known.
constexpr long kTermsOfInverse = 64;

}  // namespace

LaurentSeries::LaurentSeries(long low, Univariate polynomial, long end)
    : low_(low), polynomial_(std::move(polynomial)), end_(end) {
  trim();
}

/// Removes what is not known, and zeros before the first coefficient.
void LaurentSeries::trim() {
  if (end_ < kAll) fmpq_poly_truncate(polynomial_.raw(), std::max(end_ - low_, 0L));
  if (polynomial_.is_zero()) {
    low_ = 0;
    return;
  }
  long zeros = 0;
  while (fmpz_is_zero(polynomial_.raw()->coeffs + zeros)) ++zeros;
  fmpq_poly_shift_right(polynomial_.raw(), polynomial_.raw(), zeros);
  low_ += zeros;
}

long LaurentSeries::valuation() const { return vanishes() ? end_ : low_; }

cln::cl_RA LaurentSeries::coefficient(long order) const {
  if (order >= end_) throw NotDecided("more terms of a series would be needed");
  return polynomial_.coefficient(order - low_);
}

LaurentSeries LaurentSeries::below(long end) const {
  return {low_, polynomial_, std::min(end, end_)};
}

Univariate LaurentSeries::shifted(long low) const {
  Univariate result;
  fmpq_poly_shift_left(result.raw(), polynomial_.raw(), low_ - low);
  return result;
}

LaurentSeries operator+(const LaurentSeries& a, const LaurentSeries& b) {
  const long end = std::min(a.end_, b.end_);
  if (a.vanishes()) return b.below(end);
  if (b.vanishes()) return a.below(end);
  const long low = std::min(a.low_, b.low_);
  return {low, a.shifted(low) + b.shifted(low), end};
}

LaurentSeries operator-(const LaurentSeries& a, const LaurentSeries& b) {
  return a + LaurentSeries(cln::cl_RA(-1)) * b;
}

LaurentSeries operator*(const LaurentSeries& a, const LaurentSeries& b) {
  const auto all_zero = [](const LaurentSeries& s) {
    return s.vanishes() && s.end_ >= LaurentSeries::kAll;
  };
  if (all_zero(a) || all_zero(b)) return {};
  const long end = std::min(LaurentSeries::added(a.end_, b.valuation()),
                            LaurentSeries::added(b.end_, a.valuation()));
  if (a.vanishes() || b.vanishes()) return {0, Univariate(), end};
  const long low = a.low_ + b.low_;
  if (end >= LaurentSeries::kAll) return {low, a.polynomial_ * b.polynomial_, end};
  Univariate product;
  fmpq_poly_mullow(product.raw(), a.polynomial_.raw(), b.polynomial_.raw(),
                   std::max(end - low, 0L));
  return {low, std::move(product), end};
}

LaurentSeries LaurentSeries::derivative() const {
  Univariate result;
  for (long i = 0; i <= polynomial_.degree(); ++i) {
    Rational own(polynomial_.coefficient(i) * cln::cl_RA(low_ + i));
    fmpq_poly_set_coeff_fmpq(result.raw(), i, own.get());
  }
  return {low_ - 1, std::move(result), added(end_, -1)};
}

LaurentSeries LaurentSeries::integral() const {
  if (!cln::zerop(coefficient(-1))) throw NotDecided("an integral has a logarithm");
  Univariate result;
  for (long i = 0; i <= polynomial_.degree(); ++i) {
    if (low_ + i == -1) continue;
    Rational own(polynomial_.coefficient(i) / cln::cl_RA(low_ + i + 1));
    fmpq_poly_set_coeff_fmpq(result.raw(), i, own.get());
  }
  return {low_ + 1, std::move(result), added(end_, 1)};
}

LaurentSeries LaurentSeries::inverse() const {
  if (vanishes()) throw NotDecided("more terms of a series would be needed");
  const long terms = end_ >= kAll ? kTermsOfInverse : end_ - low_;
  Univariate result;
  fmpq_poly_inv_series(result.raw(), polynomial_.raw(), terms);
  return {-low_, std::move(result), terms - low_};
}

SeriesMatrix operator*(const SeriesMatrix& a, const SeriesMatrix& b) {
  SeriesMatrix result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    result[i].resize(b.front().size());
    for (std::size_t j = 0; j < b.front().size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k) result[i][j] = result[i][j] + a[i][k] * b[k][j];
  }
  return result;
}

SeriesMatrix inverse(SeriesMatrix matrix) {
  const std::size_t n = matrix.size();
  for (std::size_t i = 0; i < n; ++i) {
    matrix[i].resize(2 * n);
    matrix[i][n + i] = LaurentSeries(cln::cl_RA(1));
  }
  for (std::size_t column = 0; column < n; ++column) {
    const auto least = std::min_element(matrix.begin() + static_cast<std::ptrdiff_t>(column),
                                        matrix.end(), [&](const auto& a, const auto& b) {
                                          if (a[column].vanishes() != b[column].vanishes())
                                            return b[column].vanishes();
                                          return a[column].valuation() < b[column].valuation();
                                        });
    std::swap(matrix[column], *least);
    const LaurentSeries scale = matrix[column][column].inverse();
    for (std::size_t j = column; j < 2 * n; ++j) matrix[column][j] = scale * matrix[column][j];
    for (std::size_t i = 0; i < n; ++i) {
      if (i == column) continue;
      const LaurentSeries factor = matrix[i][column];
      for (std::size_t j = column; j < 2 * n; ++j)
        matrix[i][j] = matrix[i][j] - factor * matrix[column][j];
    }
  }
  for (auto& row : matrix) row.erase(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(n));
  return matrix;
}

LaurentSeries at_series(const RationalFunction& f, const LaurentSeries& z) {
  const auto value = [&](const Univariate& p) {
    LaurentSeries result;
    for (long i = p.degree(); i >= 0; --i) result = result * z + LaurentSeries(p.coefficient(i));
    return result;
  };
  if (f.denominator().is_constant()) return value(f.numerator());
  return value(f.numerator()) * value(f.denominator()).inverse();
}

}  // namespace casimir::obstruction
