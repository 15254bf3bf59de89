#pragma once

#include <cln/float.h>

#include <optional>

#include "runtime/exact/elliptic.hpp"

namespace casimir::exact {

/// Weierstrass's function of real invariants, p'^2 = 4 p^3 - g2 p - g3, on the real axis with a
/// pole at 0, as a formula in one of Jacobi's functions or in an elementary one (Abramowitz &
/// Stegun 18.9, 18.12). With s = rate * t it is
///
/// - three: low + height / sn(s)^2, where 4 x^3 - g2 x - g3 has three real roots;
/// - one: low + height (1 + cn(s)) / (1 - cn(s)), where it has one;
/// - hyperbolic, circular: low + height / sinh(s)^2, low + height / sin(s)^2, where two roots are
///   equal as far as the digits tell, and
/// - rational: 1 / t^2, where all are.
struct RealLattice {
  enum class Kind { three, one, hyperbolic, circular, rational };

  RealLattice(const cln::cl_F& g2, const cln::cl_F& g3);

  /// Whether it comes back.
  bool periodic() const { return kind != Kind::hyperbolic && kind != Kind::rational; }

  Kind kind = Kind::rational;
  cln::cl_F low, height, rate;
  cln::cl_F period;           ///< the real one, where it is periodic
  JacobiFunctions functions;  ///< of three and one
  cln::cl_F roots[3] = {};    ///< of three, falling
};

/// Of the lattice that is made of 1 and tau = shift + i * height, after division by the real
/// period: the height. The shift is 0 for `three` and 1/2 for `one`.
cln::cl_F height_of_tau(const RealLattice& lattice);

}  // namespace casimir::exact
