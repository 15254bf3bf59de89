#pragma once

#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// Whether a real point was found around which the Hamiltonian, the bracket and all that has
/// cancelled in them have values, inside all assumptions: what is said of integrals else may be
/// about nothing, as of a Hamiltonian with a part 0*sqrt(-x^2 - 1). True without a search where
/// all are rational and nothing is assumed.
bool has_inner_points(const HamiltonianSystem& system);

}  // namespace casimir::obstruction
