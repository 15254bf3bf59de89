#pragma once

#include <string>

#include "symbolic/obstruction/equation/parametric_function.hpp"

namespace casimir::obstruction {

/// The zero, or the two conjugate ones, of a polynomial in z whose coefficients are functions of a
/// parameter c.
struct ParameterPoint {
  Polynomial polynomial;    ///< irreducible
  long degree;              ///< in z: 1 or 2
  ParametricFunction s, t;  ///< the monic polynomial is z + t, or z^2 + s z + t

  /// The value a + b z of a function at the point; b is zero for a point of degree 1.
  struct Residue {
    ParametricFunction a, b;
  };
  Residue product(const Residue& x, const Residue& y) const;
  /// \throws std::domain_error  for zero
  Residue inverse(const Residue& x) const;
  Residue value(const Polynomial& f) const;

  /// As "z = c" or "z^2 - c = 0".
  std::string text(const CurveNames& names) const;
};

/// \param polynomial  of degree 1 or 2 in z
ParameterPoint parameter_point(const Polynomial& polynomial);

}  // namespace casimir::obstruction
