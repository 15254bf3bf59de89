#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "symbolic/discrete/univariate.hpp"

namespace casimir::discrete {

/// A polynomial q(a, b) on the line b = slope*a, as one of a, up to a constant factor.
struct OnLine {
  Element slope = 0;
  Univariate polynomial;
};

/// The irreducible factors of a polynomial of two variables over a prime field: of the equation of
/// a hypersurface on a random plane they are, by Bertini's theorem, those of the equation itself.
class PlaneFactors {
 public:
  /// \param lines  more than the degree, with different slopes; q(0, 0) != 0
  /// \return  nothing where they are not those of one polynomial
  static std::optional<PlaneFactors> from_lines(const std::vector<OnLine>& lines, Element prime);

  std::size_t size() const;
  long degree(std::size_t factor) const;
  unsigned long exponent(std::size_t factor) const;  ///< of its power in the polynomial
  bool vanishes(std::size_t factor, Element a, Element b) const;

 private:
  struct Factors;
  explicit PlaneFactors(std::shared_ptr<const Factors> factors) : factors_(std::move(factors)) {}

  std::shared_ptr<const Factors> factors_;
};

}  // namespace casimir::discrete
