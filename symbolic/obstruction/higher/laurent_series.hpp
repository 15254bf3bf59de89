#pragma once

#include <vector>

#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// A Laurent series in t with rational coefficients, of which those below t^end are known; the
/// others may be anything. Nothing that is computed claims a coefficient that is not known.
class LaurentSeries {
 public:
  /// Zero, all of whose coefficients are known.
  LaurentSeries() = default;
  /// A number, all of whose coefficients are known.
  explicit LaurentSeries(const cln::cl_RA& constant) : polynomial_(constant) {}
  /// t^low times a polynomial, known below t^end.
  LaurentSeries(long low, Univariate polynomial, long end);

  /// The order of the first coefficient that is not zero; of a series without one, `end`.
  long valuation() const;
  /// Coefficients of this order and above are not known.
  long end() const { return end_; }
  /// Whether no coefficient that is known differs from zero.
  bool vanishes() const { return polynomial_.is_zero(); }
  /// \throws NotDecided  for a coefficient that is not known
  cln::cl_RA coefficient(long order) const;
  /// The same with fewer known coefficients.
  LaurentSeries below(long end) const;

  friend LaurentSeries operator+(const LaurentSeries& a, const LaurentSeries& b);
  friend LaurentSeries operator-(const LaurentSeries& a, const LaurentSeries& b);
  friend LaurentSeries operator*(const LaurentSeries& a, const LaurentSeries& b);
  LaurentSeries derivative() const;
  /// Without a constant. \throws NotDecided  where the residue is not known to be zero
  LaurentSeries integral() const;
  /// \throws NotDecided  where no coefficient differs from zero
  LaurentSeries inverse() const;

 private:
  static constexpr long kAll = 1L << 40;  ///< `end` of a series with all coefficients known
  static long added(long a, long b) { return a >= kAll || b >= kAll ? kAll : a + b; }
  Univariate shifted(long low) const;
  void trim();

  long low_ = 0;
  Univariate polynomial_;  ///< of degree below end - low
  long end_ = kAll;
};

using SeriesMatrix = std::vector<std::vector<LaurentSeries>>;

SeriesMatrix operator*(const SeriesMatrix& a, const SeriesMatrix& b);
/// \throws NotDecided  where no pivot is known to differ from zero
SeriesMatrix inverse(SeriesMatrix matrix);

/// A rational function at a series. \throws NotDecided  where its denominator is not known there
LaurentSeries at_series(const RationalFunction& f, const LaurentSeries& z);

}  // namespace casimir::obstruction
