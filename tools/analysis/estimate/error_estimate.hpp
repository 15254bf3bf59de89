#pragma once

#include <optional>

#include "runtime/integrate.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// How far the end state of a run can be believed. Relative to the size of each state.
struct ErrorEstimate {
  bool known = false;         ///< false: the variational equations could not be integrated
  double conditioning = 0;    ///< largest growth of a small change of the initial state
  double on_the_way = 0;      ///< the same up to any time before the end
  double input_rounding = 0;  ///< error from rounding the scene's exact data to double
  double error_estimate = 0;  ///< difference to a run with a hundredth of the tolerance or less,
                              ///< and what double arithmetic alone costs
  /// The same of the samples, where they were asked for: on the way the state may be off by more
  /// than at the end, and methods have formulas of their own between their steps.
  std::optional<double> samples_error;
  /// What numbers within the equations that are beyond all doubles do to some state, up to 1.
  double overflow = 0;
  bool unconfirmed = false;    ///< a run with a tighter tolerance fails: there is no estimate
  bool beyond_double = false;  ///< rounding alone spoils all but a few digits, at the end or before
  /// Up to when rounding leaves six digits, where it does not to the end.
  std::optional<double> six_digits_until;
  std::optional<double> followed;  ///< the growth beyond this time is extrapolated
  /// How far a run with a tighter tolerance is from this one on the way, where both end in the same
  /// place: which way the motion took was decided by the errors of the steps.
  std::optional<double> parted;
  /// The time from which on more than one solution may go on, of which this is one: see
  /// PartingSolutions.
  std::optional<double> one_of_several;

  /// Whether changes that no double holds are made on the way and do not show at the end: which way
  /// the motion took was decided by rounding.
  bool died_out() const;
};

/// Integrates the variational equations along a finished run, and repeats it with a tighter
/// tolerance where the run took no more than three times `budget` seconds; else the estimate is an
/// upper bound of what its steps may have erred by.
ErrorEstimate assess(const PreparedScene& run, const CompiledModule& compiled, const Method& method,
                     const Settings& settings, const Trajectory& trajectory, double budget = 1);

}  // namespace casimir
