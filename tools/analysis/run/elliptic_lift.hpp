#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <vector>

#include "tools/analysis/run/validated.hpp"

namespace casimir {

/// A case in which the values of elliptic functions along a solution are further variables.
///
/// Let x' = f(x, g(x)) with values g of elliptic functions, and g' = h(x, g) by the chain rule and
/// their derivatives (DLMF 22.13, 19.18), which are algebraic in such values again. Then a solution
/// x(t) gives one of the system of x and g: (x(t), g(x(t))), since g is differentiable along it.
/// That system has no elliptic function, and its right-hand sides are differentiable where they
/// have values, so that its solution from a given start is unique: a box for the solutions of it
/// from all starts in a box, (x(0), g(x(0))) among them, contains x(t). Assumed is that g(x(0)) is
/// in the box that it starts from, which Arb's values are certain to be; and that x(t) exists for
/// as long as the box does: where an argument of Carlson's integrals goes to zero and R_D or R_J
/// depends on it, their values go to infinity, and every such value is a variable.
struct EllipticLift {
  Model model;  ///< the variables of the case and then the further ones; only for an enclosure
  Scene scene;  ///< with the middle of the box of each further variable
  /// By how much each initial value may be off, further variables included.
  std::vector<cln::cl_RA> radii;
  std::size_t own = 0;  ///< as many variables as the case has
};

/// Whether an elliptic function is in the equations, the Hamiltonian or an invariant of the case.
bool has_elliptic_functions(const Model& model);

/// The lift of a case at the parameters of a scene.
/// \throws ModelError  where a modulus depends on the variables, where two arguments of R_D or of
///                     R_J are equal, and where a value at the start is not certain to exist.
EllipticLift elliptic_lift(const Model& model, const Scene& scene, const ValidatedOptions& options);

}  // namespace casimir
