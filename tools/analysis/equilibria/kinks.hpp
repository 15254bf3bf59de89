#pragma once

#include <vector>

#include "runtime/program/interpreter.hpp"
#include "runtime/step/step_watch.hpp"

namespace casimir {

/// Where the equations go on by another formula, or have none: the arguments of |u|, sign(u) and
/// atan2(u, v), and what is divided by.
class Kinks {
 public:
  explicit Kinks(const Program& rhs);

  /// Whether such an argument is 0 at a point, as far as that is known.
  /// \param inputs  of the right-hand side, at the point
  /// \param nearby  the same at points that it cannot be told from
  bool are_at(const std::vector<double>& inputs,
              const std::vector<std::vector<double>>& nearby) const;

 private:
  std::vector<double> arguments(const std::vector<double>& inputs) const;

  StepWatch watch_;
  Interpreter evaluate_;
};

}  // namespace casimir
