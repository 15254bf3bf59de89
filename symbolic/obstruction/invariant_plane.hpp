#pragma once

#include <ginac/ginac.h>

#include <string>
#include <utility>
#include <vector>

#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// A surface on which some variables, the normal ones, are polynomials in the others; mostly zero.
struct InvariantPlane {
  std::vector<std::pair<std::size_t, GiNaC::ex>> normal;  ///< variable and its value on the surface
  std::vector<std::size_t> along;                         ///< the other variables

  /// An expression on the surface. \throws NotDecided  where it has no value there
  GiNaC::ex on(const GiNaC::ex& expression) const;
  /// As "x = 0, px = 0".
  std::string text(const HamiltonianSystem& system) const;

  GiNaC::exmap values;  ///< of the normal variables
};

/// The surface on which the functions vanish, with those that follow from them because their rates
/// have to vanish there too. \throws NotDecided  where none can be solved for a variable
InvariantPlane invariant_plane(const HamiltonianSystem& system,
                               const std::vector<GiNaC::ex>& functions);

/// Coordinate planes that the motion keeps, smallest number of normal variables first; and in
/// canonical variables those of equal and opposite pairs. Then the surfaces on which all functions
/// of one of the lists vanish, where these can be solved.
/// \param relations  as the case's invariant relations give them; they are checked here again
std::vector<InvariantPlane> invariant_planes(const HamiltonianSystem& system,
                                             const std::vector<std::vector<GiNaC::ex>>& relations);

}  // namespace casimir::obstruction
