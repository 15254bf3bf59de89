#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/program/interpreter.hpp"

namespace casimir {

/// Finds where roots of right-hand sides come to zero whose exponent is below 1/2, or below 1 of
/// |u|: there they need not be Lipschitz continuous, and more than one solution may go on. The
/// series of a solution does not show that: x = (t - 1)^3 is one of x' = 3 (x^2)^(1/3), and x = 0
/// from t = 1 on is another. (The square root of a function that is nowhere negative and has two
/// continuous derivatives is Lipschitz continuous: Glaeser, Ann. Inst. Fourier 13, 203, 1963.)
class RootZeros {
 public:
  /// \param parameters  at run time.
  RootZeros(const Program& rhs, std::vector<double> parameters);

  /// Whether there are such roots.
  bool any() const { return !values_.empty(); }

  /// Writes the state at a part of a step, from 0 to 1, and returns the time.
  using StateAt = std::function<double(double part, double* x)>;
  /// Of the largest value of a radicand in a step. Places in it are known to 10^(-16) of it, and a
  /// radicand that touches zero is about the square of that at the nearest. Steps beside one that
  /// only comes near zero are as short as it is near.
  static constexpr double kZero = 1e-27;
  /// The part of a step at which a radicand is zero; nothing where none is.
  /// \param zero  what is, of its largest value in the step
  std::optional<double> zero_in(const StateAt& state_at, double zero = kZero);
  /// Their values at a part of a step.
  const std::vector<double>& radicands(double part, const StateAt& state_at);

 private:
  double least_between(double low, double high, std::size_t which, const StateAt& state_at);

  std::size_t states_;
  std::optional<Interpreter> evaluate_;
  std::vector<double> inputs_, values_;
};

}  // namespace casimir
