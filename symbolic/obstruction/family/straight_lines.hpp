#pragma once

#include <string>
#include <vector>

#include "symbolic/obstruction/family/family_equation.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// The equations along the straight lines of a homogeneous potential with a free parameter, where
/// the system has one: those of directions of degree 1 and 2 over Q(c) with one eigenvalue.
std::vector<FamilyEquation> straight_line_families(const HamiltonianSystem& system);

/// y'' = -lambda phi^(k-2) y along a straight line c phi(t) of a potential of degree k, where
/// lambda is an eigenvalue of A V''(c): Riemann's equation in phi^k.
/// \param parameter  the name of the free one, for the text
FamilyEquation equation_of_line(const RationalFunction& lambda, long k,
                                ParameterConditions conditions, const std::string& parameter);

}  // namespace casimir::obstruction
