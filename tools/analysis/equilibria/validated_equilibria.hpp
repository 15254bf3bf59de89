#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>
#include <vector>

#include "runtime/validated_run.hpp"
#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/run/validated.hpp"

namespace casimir {

/// What is proved of the stability of an equilibrium.
enum class ProvedStability {
  undecided,  ///< neither of the others
  stable,     ///< in the sense of Lyapunov
  unstable,   ///< some eigenvalue has a positive real part
};

/// "undecided", "stable" or "unstable".
std::string to_string(ProvedStability stability);

/// An equilibrium whose existence is a theorem, or why it is not.
struct ProvedEquilibrium {
  bool proved = false;
  std::string reason;                        ///< where not
  std::vector<RationalInterval> state;       ///< there is exactly one in this box
  std::vector<RationalInterval> velocities;  ///< of the symmetries, where there are any
  cln::cl_RA radius = 0;                     ///< the largest half width of these
  ProvedStability stability = ProvedStability::undecided;
};

/// Proves each of the equilibria that `find_equilibria` found of this scene, for the exact numbers
/// of the model.
///
/// Theorem (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, chapter 5): where f
/// is continuously differentiable on a box Z around z, and z - Y f(z) + (I - Y f'(Z)) (Z - z) lies
/// in the inside of Z for some matrix Y, f has exactly one zero in Z. Values and derivatives are
/// computed in balls (Arb); that they are continuous on Z is checked by `BallEvaluator::smooth`.
/// With a bracket, f is the gradient of L = H - sum v_k F_k - sum l_c C_c with the differences of
/// C_c and F_k to their values at the scene: since J dC = 0, a zero of it rests under H - sum v_k
/// F_k. That the C_c are Casimir functions is proved first. Without a bracket f is the right-hand
/// side.
///
/// Unstable: the linearised equations of H - sum v_k F_k have an eigenvalue in the right half plane
/// (Lyapunov). Stable: all of them lie in the left one, or the second derivative of L is definite
/// on the common kernel of dC_c and dF_k, all of them integrals of that flow (Ortega and Ratiu, J.
/// Geom. Phys. 32 (1999) 160). Both are said for one symmetry at most, since several need not
/// commute.
/// \param report  of the same model and scene.
/// \param ranges  parameters that may have any value of an interval: then f(z) and f'(Z) hold for
///                all of them, and for each value there is exactly one equilibrium in the box, on a
///                smooth branch (implicit function theorem); what is said of its stability holds
///                for all as well.
/// \returns  one for each of `report.equilibria`, in their order.
std::vector<ProvedEquilibrium> enclose_equilibria(const Model& model, const Scene& scene,
                                                  const EquilibriumReport& report,
                                                  const ParameterRanges& ranges = {});

/// Puts what is proved in the place of what it contradicts: of numbers outside of their enclosures
/// the middles of these, and of what eigenvalues in doubles tell of the stability the theorem.
/// \param proofs  of the same report, or none
void take_proved(const std::vector<ProvedEquilibrium>& proofs, EquilibriumReport& report);

}  // namespace casimir
