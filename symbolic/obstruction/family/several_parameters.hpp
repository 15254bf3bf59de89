#pragma once

#include <vector>

#include "symbolic/obstruction/family/family_equation.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// Fills in the answer for several free parameters: real values survive where for every equation
/// Kimura's conditions hold (or Lame's equation is in one of its classes), or one of its `where`
/// fails. Equations of which no member with an identity component that is not solvable was found
/// exclude nothing and are not counted.
/// \throws NotDecided  where no equation excludes anything
void exclude_regions(const HamiltonianSystem& system, std::vector<GeneralEquation> equations,
                     Obstruction& result);

}  // namespace casimir::obstruction
