#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/obstruction/curve_field.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/invariant_plane.hpp"

namespace casimir::obstruction {

/// An integral curve of the equations: all variables as functions of one of them, z, in a field of
/// functions on an algebraic curve. That it is one was checked by its equations. F is
/// RationalFunction, or where the system has a free parameter ParametricFunction.
template <class F>
struct ParticularCurve {
  CurveNames names;                              ///< of the variable and of the free parameter
  std::string level;                             ///< as "H = 1, F1 = 1"
  std::string equations;                         ///< as "py^2 = 2*z + 1"
  std::vector<std::pair<std::size_t, F>> roots;  ///< variables whose squares are functions of z
  CurveField<F> field;
  std::vector<CurveElement<F>> values;  ///< of each variable
  long complexity = 0;                  ///< the degrees of the functions whose roots are taken
  CurveElement<F> speed;                ///< dz/dt, not zero
  GiNaC::exmap places;                  ///< of each symbol, the number of its value
};

/// Levels of the energy and the Casimir functions and variables z for which the motion on a surface
/// is such a curve: first the energies at which singular points fall together,
/// and of each the simplest curve first.
/// \param visit  is given each, and says whether to go on
/// \return  why there was none, or what stopped it; empty if one was visited
template <class F>
std::string for_each_curve(const HamiltonianSystem& system, const InvariantPlane& plane,
                           const std::function<bool(const ParticularCurve<F>&)>& visit);

}  // namespace casimir::obstruction
