#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "runtime/module_abi.h"
#include "runtime/program/interpreter.hpp"
#include "runtime/step/step_watch.hpp"

namespace casimir {

/// Finds poles that a step goes over: zeros of what the equations divide by, at which a rate is
/// infinite with another sign on each side. A solution ends there, or is drawn to the pole from
/// both sides, as that of x' = 1/(1 - x) is; a step that ends behind it is none of the equations.
/// Where the rates stay finite, as those of sin(x)/x do, or keep their sign, as 1/x^2 does, the
/// motion may go on.
class StepPoles {
 public:
  /// Borrows the watch.
  StepPoles(const StepWatch& watch, std::size_t states);

  /// Another run begins, with the same equations.
  /// \param parameters  null if there are none; borrowed.
  void begin(const double* parameters);

  /// Whether a divisor changes its sign between the ends of a step.
  /// \param first,last  the arguments of the watch at these.
  bool may_lie_between(const double* first, const double* last) const;

  /// The part of a step at which it comes to the first pole; nothing where it goes over none.
  std::optional<double> first_in(const casimir_step& trial, const double* first,
                                 const double* last);

 private:
  const double* at(const casimir_step& trial, double part);
  double divisor_at(const casimir_step& trial, std::size_t which, double part) {
    return at(trial, part)[states_ + which];
  }
  double zero_in(const casimir_step& trial, std::size_t which, double first);
  double rates_at(const casimir_step& trial, double part, std::size_t which,
                  std::vector<double>& rates);
  double size_of(const casimir_step& trial) const;
  bool is_pole(const casimir_step& trial, std::size_t which, double zero);
  bool is_pole_by_ends(const casimir_step& trial, std::size_t which);
  bool grows(double before, double behind, double far, double near, double size) const;
  bool is_infinite(const casimir_step& trial, std::size_t which);

  const StepWatch& watch_;
  const std::size_t states_;
  Interpreter evaluate_;
  std::vector<double> inputs_, outputs_;
  std::vector<double> before_, behind_, far_;  ///< rates around a zero
  std::optional<std::size_t> known_;           ///< whose zero is known to be a pole
};

}  // namespace casimir
