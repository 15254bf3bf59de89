#pragma once

#include <cln/float.h>
#include <cln/real.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// What a multiprecision run integrates. The programs must outlive it.
struct PreciseProblem {
  const Program* rhs = nullptr;
  const Program* invariants = nullptr;  ///< of the same inputs; none: nothing is followed
  /// Initial state, run-time parameters and duration, right to that many digits.
  std::function<std::vector<cln::cl_R>(int digits)> start;
  cln::cl_RA sample_every = 0;       ///< > 0: states at its multiples, from the dense output
  unsigned long long max_steps = 0;  ///< 0: no limit
  /// Asked before each step with the share of the duration that is done; true ends the run.
  std::function<bool(double share)> give_up = {};
  std::optional<cln::cl_R> end = {};   ///< in the place of the duration
  std::optional<cln::cl_R> mark = {};  ///< a time whose state is wanted
  bool keep_way = false;               ///< whether the ends of steps are kept, see PreciseRun::way
  /// Times, in order, of which the states are wanted; these are kept instead of the ends of steps.
  std::vector<cln::cl_F> places = {};
  /// To begin, where a state has to be rounded, on the other side of its exact value: what the
  /// rounding comes to is seen beside a run that begins at the nearest numbers.
  bool from_other_side = false;
};

/// A function that should stay constant along a run.
struct PreciseInvariant {
  cln::cl_F initial, final;
  cln::cl_F change;  ///< largest |I(t) - I(0)| after any step
};

/// What came of a run. Where it stopped early, `time` and `state` are those of the last step.
struct PreciseRun {
  Status status = Status::ok;
  std::string reason = {};  ///< a sentence, where the status is not ok
  int digits = 0;           ///< it was made with
  cln::cl_F time = {};
  std::vector<cln::cl_F> state = {};
  std::optional<cln::cl_F> singular_time = {};  ///< where the solution ends, known that well
  std::vector<cln::cl_F> at_mark = {};          ///< empty if the run did not get there
  std::vector<double> log2_sizes = {};          ///< largest |x_i| after any step
  /// States on the way: at the ends of steps, of a few thousand at most, or at the places asked
  /// for.
  std::vector<cln::cl_F> way_times = {};
  std::vector<std::vector<cln::cl_F>> way = {};
  std::vector<PreciseInvariant> invariants = {};
  std::vector<cln::cl_F> sample_times = {};
  std::vector<std::vector<cln::cl_F>> samples = {};
  unsigned long long steps = 0;
  double seconds = 0;
};

/// Integrates from time 0 by Taylor series whose order is 1.15 times the digits, which makes each
/// step shorter than the radius of convergence by exp(2): the least work for a given precision
/// (Jorba & Zou, Experimental Mathematics 14, 99, 2005). Truncation and rounding errors of a step
/// are 10^-digits of the state, with some digits to spare; errors that the motion magnifies are not
/// counted, see `agreed_run`. Cost: about (order)^2 / 6 products of long numbers for each
/// multiplication of the program and step.
PreciseRun precise_run(const PreciseProblem& problem, int digits);

/// How much memory such a run takes, roughly: a series for each line of the program, which grows
/// like the square of the digits.
double precise_run_bytes(const PreciseProblem& problem, int digits);

}  // namespace casimir
