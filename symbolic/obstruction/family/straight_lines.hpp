#pragma once

#include <vector>

#include "symbolic/obstruction/family/family_equation.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// The equations along the straight lines of a homogeneous potential with a free parameter, where
/// the system has one: those of directions of degree 1 and 2 over Q(c) with one eigenvalue.
std::vector<FamilyEquation> straight_line_families(const HamiltonianSystem& system);

}  // namespace casimir::obstruction
