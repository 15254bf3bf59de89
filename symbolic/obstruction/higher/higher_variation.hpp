#pragma once

#include <functional>
#include <string>
#include <vector>

#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/invariant_plane.hpp"
#include "symbolic/obstruction/normal_variation.hpp"
#include "symbolic/obstruction/particular_curve.hpp"

namespace casimir::obstruction {

/// What the variational equations of higher order along a curve show.
struct HigherVariation {
  bool decisive = false;  ///< the identity component of one of them is not abelian
  unsigned order = 0;     ///< the highest that was examined
  std::string residue;    ///< where decisive: the logarithm's coefficient
  std::string outcome;    ///< in words
};

/// Examines the variational equations of order 2, 3, .. along a curve on which the normal
/// variational equation has a solvable identity component, by the logarithm at the curve's only
/// point at infinity.
///
/// The theorem (Morales-Ruiz, Ramis and Simo, Ann. Sci. Ecole Norm. Sup. 40 (2007) 845): where a
/// system is integrable by meromorphic integrals near a curve, the Galois group G_k of each
/// variational equation VE_k along it has an abelian identity component. Let the curve be
/// z'^2 = S(z) with a cubic S, let all coefficients be polynomials in z and z', which are infinite
/// at t = 0 only, let VE_1 have trivial monodromy around t = 0, and let the first monodromy there
/// that is not trivial be M of VE_k, with logarithm 2 pi i N. M is unipotent and so lies in the
/// identity component of G_k. N belongs to the vector group Hom(S^k V, V), the kernel of G_k ->
/// G_(k-1), V the solutions of VE_1; G_k acts on it by G_1. There are two degrees of freedom, and V
/// = V_t + V_n: the equations along the plane, where the motion's own direction is fixed and areas
/// are kept so that G_1 acts by unipotent matrices, and those normal to it, with two invariant
/// lines y1 and y2, or one, y1 = y2.
///
/// (1) If G_1 acts on V_n by an infinite group, and y1, y2 are two lines, its identity component
/// contains the diagonal matrices (s, 1/s). Let G_k's be abelian: it contains a torus above them,
/// which commutes with M. So N has weight 0: the forms in the constants of V_n that it is made of
/// are multiples of (c1 c2)^m, c1 and c2 belonging to y1 and y2. A difference of exponents that is
/// not rational shows that the group is infinite.
///
/// (2) If S has no double root, the curve is a torus C/Lambda without t = 0, and VE_1 has two
/// commuting monodromy matrices A and B, one for each period; let y1 y2 be a function on the curve,
/// so that both keep the lines. Let G_k's identity component be abelian and contain A^n and B^n,
/// lifted. The loop around the cell of n Lambda is their commutator, 1, and also the product of the
/// loops around its n^2 points, conjugates of M by A^i B^j, which commute: the sum of A^i B^j N
/// over 0 <= i, j < n is zero. The unipotent parts of A and B lie in the identity component and
/// leave N alone, the semisimple ones leave its part of weight 0 alone (on one line: the forms of
/// even degree), n^2 times which is part of that sum. So that part is zero: (d/dc1 d/dc2)^m of each
/// form of degree 2m.
///
/// G_k has no abelian identity component where N is not as (1) says, or not as (2) says. Checked
/// here: polynomial equations and coordinates, S, the two blocks and their traces, the function
/// y1 y2 on the curve (from the invariants of `rational_invariant`), the exponents, and of all
/// series
/// the number of their known terms. \throws NotDecided  where a hypothesis fails
HigherVariation examine_higher(const HamiltonianSystem& system, const InvariantPlane& plane,
                               const ParticularCurve<RationalFunction>& curve,
                               const NormalEquation<RationalFunction>& equation,
                               unsigned highest_order, const std::function<void()>& tick);

}  // namespace casimir::obstruction
