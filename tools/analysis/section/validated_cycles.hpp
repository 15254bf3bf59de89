#pragma once

#include <string>
#include <vector>

#include "runtime/validated_run.hpp"
#include "tools/analysis/run/validated.hpp"
#include "tools/analysis/section/cycles.hpp"

namespace casimir {

/// A periodic orbit whose existence is a theorem, or why it is not.
struct ProvedCycle {
  bool proved = false;
  std::string reason;                   ///< where not
  std::vector<RationalInterval> state;  ///< where it crosses the plane
  RationalInterval period{0, 0};        ///< after which it is there again
  /// The sum of the two Floquet multipliers that are not 1 by the motion along the orbit and across
  /// the levels.
  RationalInterval trace{0, 0};
  cln::cl_RA radius = 0;    ///< the largest half width of the state and the period
  bool keeps_area = false;  ///< it is proved that the product of the two multipliers is 1

  /// "elliptic", "hyperbolic" or "inverse hyperbolic" where the product of the multipliers is
  /// proved to be 1 and the trace is certain to lie within, above or below (-2, 2); else
  /// "undecided".
  std::string kind() const;
};

/// Proves that there is a periodic orbit near each cycle that a search found, and no other near it
/// on the level and the plane.
///
/// With the flow phi, the unknowns are a point x of the plane and a time T; the equations are
/// s(x) = 0, I_a(x) = c_a for H and the Casimir functions, and (phi_T(x) - x)_i = 0 for as many i
/// as are missing. Krawczyk's operator maps a box of (x, T) into its inside, so that they have
/// exactly one solution there. phi_T(x) and its derivatives by x are enclosed over the box by
/// `validated::FlowMap`, and that by T is f(phi_T(x)). The other differences are zero as well: both
/// points lie on one level, and the derivatives of the I_a by the other coordinates are a regular
/// matrix over the hull of both boxes (mean value theorem). This needs that the I_a are constant
/// along the flow: that their derivatives along it vanish is proved first for the Casimir functions
/// and holds for H, and that they do not jump is asked of all of the way (`FlowImage::not_kept`)
/// and of the hull: z - arg(x + i y) returns to its value with another z.
///
/// The levels are those numbers and all others within 2^-52 of them, of their size.
/// The trace is that of the derivative of phi_T less one for each I_a and one for the direction of
/// the flow: these are eigenvalues 1, since the flow keeps the I_a and its own direction. That the
/// product of the other two is 1 is a theorem of symplectic flows on a leaf of dimension 4 with all
/// Casimir functions named: the Jacobi identity is proved for it, and the rank of the bracket is
/// enclosed. What is proved is a period; it need not be the least.
/// \param ranges   parameters that may have any value of an interval: what is proved then holds for
///                 each of them, with the level as it is, and the cycles are a smooth branch
///                 (implicit function theorem). The function of the plane must not depend on them.
/// \param longest  seconds for each of them, about.
std::vector<ProvedCycle> enclose_cycles(const Model& model, const Scene& scene,
                                        const SectionProblem& problem,
                                        const std::vector<Cycle>& cycles,
                                        const ParameterRanges& ranges = {}, double longest = 60);

}  // namespace casimir
