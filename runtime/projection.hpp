#pragma once

#include <utility>
#include <vector>

#include "runtime/program.hpp"
#include "runtime/program/angle_branches.hpp"
#include "runtime/program/interpreter.hpp"

namespace casimir {

/// Puts a state back onto the level of invariants that a run began on.
///
/// Newton's method along the gradients, x -> x - D G' (G D G')^+ (I(x) - I(0)), where G has a
/// gradient in each row and D the squares of the largest |x_i| so far, so that a state of large and
/// small components is moved in proportion (Hairer, Lubich, Wanner: Geometric Numerical Integration
/// (2006), IV.4). The invariants are evaluated in long double, at the state with its carry. Where
/// gradients depend on each other the rest is left as it is, and so is a state too far from the
/// level: then the step is wrong, and not its rounding.
class Projector {
 public:
  /// \param invariants  outputs over the states, the run-time parameters and the time.
  /// \param chosen  which of them, by index.
  /// \param gradients  over the same inputs; `entries` has the state and the invariant of each
  ///     output.
  Projector(Program invariants, std::vector<std::size_t> chosen, const Program& gradients,
            std::vector<std::pair<int, int>> entries, const std::vector<double>& initial,
            std::vector<double> parameters);

  /// Changes the state x + carry at the time t.
  void operator()(double t, double* x, double* carry);

 private:
  /// What the chosen invariants are away from their first values, and the sizes of their terms.
  void evaluate(double t, const double* x, const double* carry, std::vector<long double>& values,
                std::vector<long double>& sizes) const;
  /// One step of Newton's method; false where there is nothing to do or nothing that helps.
  bool improve(double t, double* x, double* carry);

  Program invariants_;
  std::vector<std::size_t> chosen_;
  Interpreter gradients_;
  std::vector<std::pair<int, int>> entries_;
  std::size_t states_;
  std::vector<Angle> angles_;  ///< of the invariants, whose branches are not told apart
  std::vector<bool> has_angles_;
  std::vector<long double> start_;  ///< the inputs
  std::vector<double> parameters_;
  std::vector<long double> level_;
  std::vector<double> reach_;  ///< largest |x_i| so far
};

}  // namespace casimir
