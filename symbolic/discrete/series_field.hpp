#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "symbolic/discrete/prime_field.hpp"

namespace casimir::discrete {

/// A Laurent series in eps over the field of `kSplittingPrime`, of which the first terms are known:
/// eps^valuation (terms[0] + terms[1] eps + ..), terms[0] != 0. Without terms it is
/// O(eps^valuation), which may be zero.
struct Series {
  static constexpr long kNever = std::numeric_limits<long>::max() / 8;

  long valuation = kNever;  ///< with no terms and `kNever`: exactly zero
  std::vector<Element> terms{};

  bool is_zero() const { return terms.empty() && valuation == kNever; }
};

/// Thrown where the known terms do not tell whether a series is zero.
struct TooFewTerms : std::runtime_error {
  TooFewTerms() : std::runtime_error("too few terms of a series are known") {}
};

/// Their arithmetic, with at most so many terms.
class SeriesField {
 public:
  explicit SeriesField(std::size_t most) : most_(most) {}

  /// Whether all series are numbers, or powers of eps, or not known.
  bool has_numbers_only() const { return most_ == 1; }
  Series constant(Element a) const;
  /// a + b eps.
  Series line(Element a, Element b) const;
  Series add(const Series& a, const Series& b) const;
  Series subtract(const Series& a, const Series& b) const {
    return add(a, scaled(b, kSplittingPrime - 1));
  }
  Series scaled(const Series& a, Element factor) const;
  Series multiply(const Series& a, const Series& b) const;
  Series power(Series a, std::uint64_t n) const;
  /// Empty for zero.
  /// \throws TooFewTerms
  std::optional<Series> inverse(const Series& a) const;

  using Rows = std::vector<std::vector<Series>>;
  /// The square matrix in the first columns becomes the unit matrix by row operations.
  /// \return  its determinant, or zero, where it is singular and the rows are of no use
  /// \throws TooFewTerms
  Series eliminate(Rows& rows) const;

 private:
  std::size_t pivot_of(const Rows& rows, std::size_t column) const;

  std::size_t most_;
  PrimeField field_{kSplittingPrime};
};

}  // namespace casimir::discrete
