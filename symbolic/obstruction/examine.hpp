#pragma once

#include <functional>
#include <string>

#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/normal_variation.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction {

/// What the unknown of an equation is called whose variable has the name z.
std::string unknown_beside(const std::string& z);

/// Decides one normal variational equation; with three singular points that are rational numbers
/// Kimura's theorem has to agree. \throws std::logic_error  if it does not
Examined examine_equation(const NormalEquation<RationalFunction>& equation, const std::string& z,
                          const std::function<void()>& tick);

/// Adds what the straight lines of a homogeneous potential of two degrees of freedom show, where
/// the system has one; sets `proved`.
void examine_straight_lines(const HamiltonianSystem& system, Obstruction& result);

}  // namespace casimir::obstruction
