#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// What y'' = r y is like at a pole of r, or at all conjugate poles that share an irreducible
/// polynomial, or at infinity.
struct Singularity {
  Univariate at;   ///< monic and irreducible; the constant 1 stands for infinity
  long order = 0;  ///< of the pole; at infinity deg(denominator) - deg(numerator) of r
  /// Of a regular singular point: the square of the difference of the two exponents, an element of
  /// the number field Q[z]/at (a number at infinity).
  Univariate difference_squared;

  bool at_infinity() const { return at.is_constant(); }
  /// Whether both exponents exist (Fuchs): a pole of order 2 at most, and at infinity a zero of
  /// order 2 at least.
  bool regular() const { return at_infinity() ? order >= 2 : order <= 2; }
  /// The difference of the exponents where it is a rational number; it is taken as positive.
  std::optional<cln::cl_RA> rational_difference() const;
  /// As "z = 1: exponents 0, 1/2".
  std::string text(const std::string& variable) const;
};

/// The poles of r and then infinity.
std::vector<Singularity> singularities(const RationalFunction& r);

/// The value in Q[z]/f of r*f^order at a root of the irreducible f, divided by f'^order: the
/// leading coefficient of Laurent's series at a pole of that order.
Univariate leading_coefficient(const RationalFunction& r, const Univariate& f, long order);

}  // namespace casimir::obstruction
