#pragma once

#include <vector>

#include "symbolic/obstruction/family/family_equation.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/invariant_plane.hpp"

namespace casimir::obstruction {

/// Normal variational equations along the surfaces that are Riemann's for almost every value of the
/// system's free parameter, each once, and those of straight lines. What was not one is told in
/// `left_out`.
std::vector<FamilyEquation> family_equations(const HamiltonianSystem& system,
                                             const std::vector<InvariantPlane>& planes,
                                             const search::Watch& watch,
                                             std::vector<std::string>& left_out);

/// The same for several free parameters, without straight lines.
std::vector<GeneralEquation> general_equations(const HamiltonianSystem& system,
                                               const std::vector<InvariantPlane>& planes,
                                               const search::Watch& watch,
                                               std::vector<std::string>& left_out);

/// Fills in the answer for the free parameter: which of its real values survive all equations.
/// \param examine  is asked about a rational value that survives
void exclude_values(const HamiltonianSystem& system, std::vector<FamilyEquation> equations,
                    const std::function<Obstruction(const cln::cl_RA&)>& examine,
                    Obstruction& result);

}  // namespace casimir::obstruction
