#pragma once

#include <string>
#include <vector>

#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {

/// A part of the normal variational equations of two unknowns, as one equation of second order.
struct NormalEquation {
  std::vector<std::string> unknowns;
  RationalFunction p, q;     ///< y'' + p y' + q y = 0, with the derivatives by z
  RationalFunction reduced;  ///< r of y'' = r y
};

/// The variational equations along the curve, of what is normal to the surface and tangent to the
/// level of the Casimir functions, split into parts that are solved one after the other.
struct NormalVariation {
  std::size_t freedom = 0;  ///< degrees of freedom of the whole system
  std::vector<NormalEquation> equations;
  std::vector<std::string> left_out;  ///< parts that are not treated, with the reason
};

/// \throws NotDecided  where the surface is not invariant along the curve, or where the Casimir
///                     functions are not as many as the brackets' rank along the curve leaves
NormalVariation normal_variation(const HamiltonianSystem& system, const InvariantPlane& plane,
                                 const ParticularCurve& curve);

}  // namespace casimir::obstruction
