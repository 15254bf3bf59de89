#pragma once

#include <vector>

#include "runtime/integrate.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// Whether the state and its rates are finite numbers. Coefficients of its Taylor series may still
/// be none.
bool has_rates(const Module& module, double t, const std::vector<double>& x,
               const std::vector<double>& parameters);

/// What the end state of a run owes to doubles within the equations.
struct ErrorOfRates {
  double rounding = 0;  ///< as in (1 - cos(x))/x for small x or cos(t + 10^16)
  /// Of rates that are others since a number on the way to them is beyond all doubles, as x^2 in
  /// x/sqrt(1 + x^2) is at 10^200; relative to their own states, up to 1.
  double overflow = 0;
};

/// The same along a run. Rounding is relative to `sizes`, and 0 where the rates are right to some
/// units of the last digit. No step size and no other method shows it, since all evaluate the
/// equations with the same digits.
///
/// The rates are compared with those in many digits, at the samples of the trajectory; what they
/// differ by is summed up along it.
ErrorOfRates error_of_rates(const PreparedScene& run, const Module& module,
                            const Trajectory& trajectory, const std::vector<double>& sizes);

/// What rounding within the equations at one state would do to the largest of the states in
/// the time `left`, relative to it.
double rounding_of_rates_at(const PreparedScene& run, const Module& module, double t,
                            const std::vector<double>& x, double left);

}  // namespace casimir
