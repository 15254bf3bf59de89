#pragma once

#include <cln/float.h>
#include <cln/real.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// A solution that errors are measured against, with a bound of its own error.
struct Reference {
  bool reached = false;  ///< the end was reached; else `reason` says why not
  std::string reason;
  bool singular = false;         ///< that is the reason: the solution has no value after `time`
  std::vector<cln::cl_F> state;  ///< at `time`
  cln::cl_R time;
  /// The largest relative difference of a component to a run with ten digits less, see `AgreedRun`.
  double error_bound = 0;
  int digits = 0;  ///< of the second run
  unsigned long steps = 0;
};

/// Integrates from time 0 by `agreed_run`: repeats the run with more digits until two of them agree
/// to the digits asked for; if they never do, `error_bound` says so.
/// \param initial  one number for each state; exact numbers stay exact until they are rounded to
///     the working precision.
/// \param duration  may be negative or zero.
/// \param digits  decimal digits asked for; at least 20.
/// \param give_up  is asked now and then; true ends the computation (`reached` is false).
Reference reference_solution(const Program& rhs, const std::vector<cln::cl_R>& initial,
                             const cln::cl_R& duration, int digits = 30,
                             const std::vector<cln::cl_R>& parameters = {},
                             const std::function<bool()>& give_up = {});

}  // namespace casimir
