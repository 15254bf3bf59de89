#pragma once

#include <functional>
#include <vector>

#include "runtime/precise_run.hpp"

namespace casimir {

/// A run and another one with fewer digits, of lower order, that was made to check it. What both
/// agree in is right, where they also keep together all the way: they share neither steps nor order
/// nor rounding. Runs that leave a motion by their rounding, as one beside an unstable rest, do so
/// at different times, and may end in the same place.
struct AgreedRun {
  PreciseRun run;    ///< the better one
  PreciseRun check;  ///< its state is at the same time; empty where `checked` is false
  bool checked = false;
  /// Digits in which the states agree, at most those asked for. A component that is zero to that
  /// many digits of the state and of its own largest value is not counted.
  int digits = 0;
  double log10_error = 0;  ///< of the check: the largest relative difference behind `digits`
  int lost = 0;            ///< digits that the motion magnified errors by
  int runs = 0;            ///< in all
};

/// Decimal digits in which a agrees with b, relative to b; at most `most`.
int agreed_digits(const cln::cl_F& a, const cln::cl_F& b, int most);

/// Repeats a run with more digits and higher order until two of them agree to the digits asked for,
/// or until the run stops for want of time. What the motion costs in digits is found by short runs
/// first, where that is cheap beside the whole.
///
/// A run that meets a singularity is checked by its singular time, and by the state at the last
/// step of the check; one that stops at the limit of steps, by the state there. If the time is up,
/// `run.status` is `stopped` and the rest is the best that was had until then.
/// \param begin  told the digits of each run before it starts.
AgreedRun agreed_run(PreciseProblem problem, int digits,
                     const std::function<void(int digits)>& begin = {});

}  // namespace casimir
