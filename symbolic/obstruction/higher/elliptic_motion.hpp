#pragma once

#include <vector>

#include "symbolic/obstruction/higher/laurent_series.hpp"
#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {

/// A motion z'^2 = S(z) with a cubic S: z is an elliptic function of the time, or where S has a
/// double root a degenerate one, with a double pole at t = 0 and no other one in a cell.
struct EllipticMotion {
  Univariate cubic;                   ///< S
  bool degenerate = false;            ///< S has a double root
  LaurentSeries z, speed;             ///< z and z' at t = 0
  std::vector<LaurentSeries> values;  ///< of each variable of the system
};

/// The curve as such a motion on which every variable is a polynomial in z and z', so that t = 0 is
/// the only point at which one is infinite.
/// \param terms  how many coefficients of the series are made
/// \throws NotDecided  where it is none
EllipticMotion elliptic_motion(const ParticularCurve<RationalFunction>& curve, long terms);

}  // namespace casimir::obstruction
