#pragma once

#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// What is left of the equations where they are solved: rounding of their terms.
constexpr double kSolved = 1e-11;
/// Pivots below it are rounding of the derivative, whatever the equations do nearby.
constexpr double kNoChange = 1e-14;

/// Leads a point to a solution by Newton's iteration; false where it does not converge.
bool solve(const ScaledEquations& equations, Place& place);

}  // namespace casimir::equilibria
