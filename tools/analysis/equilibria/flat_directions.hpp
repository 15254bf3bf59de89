#pragma once

#include <Eigen/Core>

#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// Pivots below it are zero: directions in which the equations do not change to first order.
constexpr double kFlat = 1e-8;
constexpr double kManyRoundings = 10;

/// Directions from a solution, a column each.
struct Directions {
  Eigen::MatrixXd flat;     ///< in which the equations do not change to first order, as far as can
                            ///< be told
  Eigen::MatrixXd zero;     ///< those of them in which the derivative is nothing but rounding
  Eigen::MatrixXd regular;  ///< the others, each as long as the solution may be off: by rounding of
                            ///< the equations, and by what is left of them
};

/// At a solution, in units of the equations, for the state and the velocities.
Directions directions_at(const ScaledEquations& equations, const Place& place);

}  // namespace casimir::equilibria
