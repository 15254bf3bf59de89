#pragma once

#include <vector>

#include "symbolic/obstruction/family/family_equation.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// The variational equations along straight lines of a homogeneous potential of three and more
/// degrees of freedom, for every value of the free parameter: `examine_lines_in_space` has the
/// theorem. Lines whose directions have the entries 0, 1 and -1 are looked at, and eigenvalues that
/// are rational functions of the parameter; there may be others, which would exclude more.
std::vector<FamilyEquation> families_of_lines_in_space(const HamiltonianSystem& system);

}  // namespace casimir::obstruction
