#pragma once

#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// What is left of the equations where they are solved: rounding of their terms.
constexpr double kSolved = 1e-11;
/// So many roundings of their terms may be left of rates and levels at a solution.
constexpr double kRoundingOfTerms = 0x1p-50;
/// Of the units of states and velocities: by so much an iteration may leave off what is 0.
constexpr double kRoundingOfPlace = 1e-15;
/// Pivots below it are rounding of the derivative, whatever the equations do nearby.
constexpr double kNoChange = 1e-14;

/// Leads a point to a solution by Newton's iteration; false where it does not converge, or to where
/// more is left of the equations than rounding makes of their terms there, and of the point: a
/// residual that is small beside the rates elsewhere may be all that there is of x^2 + 1e-12.
bool solve(const ScaledEquations& equations, Place& place);

}  // namespace casimir::equilibria
