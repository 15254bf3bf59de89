#pragma once

#include <string>
#include <vector>

#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {

/// A part of the normal variational equations of two unknowns, as one equation of second order.
template <class F>
struct NormalEquation {
  std::vector<std::string> unknowns;  ///< y is the first
  F p, q;                             ///< y'' + p y' + q y = 0, with the derivatives by z
  F reduced;                          ///< r of y'' = r y
};

/// The variational equations along the curve, of what is normal to the surface and tangent to the
/// level of the Casimir functions, split into parts that are solved one after the other.
template <class F>
struct NormalVariation {
  std::size_t freedom = 0;  ///< degrees of freedom of the whole system
  std::vector<NormalEquation<F>> equations;
  std::vector<std::string> left_out;  ///< parts that are not treated, with the reason
};

/// \throws NotDecided  where the surface is not invariant along the curve, or where the Casimir
///                     functions are not as many as the brackets' rank along the curve leaves
template <class F>
NormalVariation<F> normal_variation(const HamiltonianSystem& system, const InvariantPlane& plane,
                                    const ParticularCurve<F>& curve);

}  // namespace casimir::obstruction
