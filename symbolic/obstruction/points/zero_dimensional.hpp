#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// Conjugate common zeros of polynomials: each coordinate as a polynomial in a root t of an
/// irreducible polynomial.
struct AlgebraicPoint {
  Univariate field;                     ///< monic and irreducible
  std::vector<Univariate> coordinates;  ///< modulo `field`, one for each variable of the ring
};

/// The common zeros of some polynomials.
struct CommonZeros {
  std::vector<AlgebraicPoint> points;  ///< each was put into the polynomials
  bool finite = true;                  ///< no variable is left free by the basis that was found
};

/// Finds them: a Groebner basis, its radical (Seidenberg: square-free polynomials in one variable
/// each are added), and a linear form that tells all zeros apart, as whose polynomials the
/// coordinates are found (the shape lemma). Where the zeros are not finitely many none is given.
/// That all were found rests on the basis being one; each that is given is a zero.
/// \throws NotDecided  where there are more than some hundred
CommonZeros common_zeros(const std::vector<Polynomial>& equations,
                         const std::function<void()>& tick);

/// The value of a polynomial at a point, modulo its field.
Univariate value_at(const Polynomial& polynomial, const AlgebraicPoint& point);

}  // namespace casimir::obstruction
