#pragma once

#include <cstddef>
#include <random>

#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// Solutions nearer than this, in units of the states, are one.
constexpr double kNearEachOther = 1e-6;

/// The dimension of the solutions near one that is solved: a flat direction belongs to a family
/// only if there are solutions at some distance that way. The minimum of q^10 is flat, and alone.
std::size_t family_at(const ScaledEquations& equations, const Place& place,
                      std::mt19937_64& random);

/// Whether nothing between two solutions tells them apart: the straight way has no residual.
bool joined_straight(const ScaledEquations& equations, const Place& a, const Place& b);

/// Whether one solution goes over into another through others: short ways towards it, each put back
/// onto the solutions.
bool joined(const ScaledEquations& equations, const Place& a, const Place& b);

}  // namespace casimir::equilibria
