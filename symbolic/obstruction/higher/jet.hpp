#pragma once

#include <ginac/ginac.h>

#include <map>
#include <vector>

#include "symbolic/obstruction/higher/laurent_series.hpp"

namespace casimir::obstruction {

/// The exponents of a monomial in the constants of a solution.
using Monomial = std::vector<unsigned>;
unsigned total(const Monomial& monomial);

/// A polynomial in the constants c1, c2, .. whose coefficients are Laurent series in t, up to some
/// degree in the constants.
class Jet {
 public:
  Jet() = default;
  Jet(std::size_t constants, const LaurentSeries& value);
  /// The constant c_i times a series.
  static Jet constant(std::size_t constants, std::size_t i, const LaurentSeries& factor);

  const std::map<Monomial, LaurentSeries>& terms() const { return terms_; }
  /// Adds a term.
  void add(const Monomial& monomial, const LaurentSeries& value);
  /// Its terms of one degree.
  Jet of_degree(unsigned degree) const;

  friend Jet operator+(Jet a, const Jet& b);
  /// Without what has a degree above `degree`.
  static Jet product(const Jet& a, const Jet& b, unsigned degree);

 private:
  std::map<Monomial, LaurentSeries> terms_;
};

/// A polynomial in some symbols where these have the values given, up to a degree.
/// \throws NotDecided  for what is no polynomial with rational coefficients
Jet value(const GiNaC::ex& polynomial, const std::vector<GiNaC::symbol>& symbols,
          const std::vector<Jet>& values, std::size_t constants, unsigned degree);

}  // namespace casimir::obstruction
