#pragma once

#include <cln/rational.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/program.hpp"
#include "runtime/run_trace.hpp"

namespace casimir {

/// A closed interval with rational ends.
struct RationalInterval {
  cln::cl_RA low;   ///< its lower end
  cln::cl_RA high;  ///< its upper end
};

/// A function that is known to be constant along all solutions, as long as they stay where it is
/// analytic. What is no such function makes the result of a run false.
struct KnownIntegral {
  std::string name;         ///< by which the run refers to it
  Program value;            ///< of the states and the time; one output
  Program gradient;         ///< of the same inputs: its nonzero entries
  std::vector<int> states;  ///< the state by which each of them is the derivative
};

/// An initial value problem to be enclosed. The programs must outlive the run.
struct ValidatedProblem {
  Program rates;     ///< of the states and the time, which comes last
  Program jacobian;  ///< of the same inputs: the entries that are not identically zero
  std::vector<std::pair<int, int>> entries;  ///< the row and column of each of them
  /// Without inputs; the exact initial value of each state, and then the duration, which is
  /// negative for a run back in time.
  Program start;
  /// By how much each state may be off at the start, on both sides; empty: by nothing.
  std::vector<cln::cl_RA> radii = {};
  std::vector<KnownIntegral> integrals = {};  ///< by which the box is made smaller
  /// Where it has outputs: a function s of the states and the time, and its derivative by the time
  /// along solutions. All zeros of s on the way are enclosed.
  Program plane = {};
};

/// How an enclosure is made.
struct ValidatedSettings {
  int digits = 0;      ///< 0: double precision; else decimal digits of the balls
  int order = 0;       ///< of the Taylor series; 0: by the digits
  int log2_error = 0;  ///< of a step in units of the state, negative; 0: by the digits
  unsigned long long max_steps = 0;  ///< 0: no limit
  cln::cl_RA sample_every = 0;       ///< > 0: boxes at its multiples
  /// Asked before each step with the share of the duration that is done; true ends the run.
  std::function<bool(double share)> give_up = {};
  /// Encloses the derivatives of the states at the end by those at the start too.
  bool derivatives = false;
  /// Where every step is written down, to be verified by others; the sets are then wider by some
  /// 2^-20 of their size. Of a run whose status is ok.
  RunTrace* trace = nullptr;
  /// Only for tests, which have to see that what is left out is missed: steps without their
  /// remainder, which makes every statement of the run false.
  bool without_remainder = false;
  /// The same: takes s for monotone wherever it may vanish.
  bool without_monotony = false;
};

/// States at a time, all of them within the box.
struct StateBox {
  cln::cl_RA
      time;  ///< of samples exact; of the end at most 2^-60 of it off, where it is irrational
  std::vector<RationalInterval> states;  ///< one for each state, in their order
};

/// A zero of the function s of a problem: every solution from the start has exactly one within
/// `time`, and its state is then in the box.
struct ValidatedCrossing {
  RationalInterval time;                 ///< contains that of each solution
  std::vector<RationalInterval> states;  ///< one for each state, in their order
  bool upwards = true;                   ///< s increases with the time
};

/// Why an enclosure ended before its time.
enum class ValidatedStatus {
  ok,             ///< it reached its time
  no_enclosure,   ///< beyond the time of `end` none could be found
  contradiction,  ///< an integral excludes every state of the box: it is not one
  touching,       ///< s may vanish without changing its sign
  max_steps,      ///< as many steps were made as were allowed
  stopped,        ///< `give_up` said so
};

/// What was proved: the solution from each possible start exists up to the time of `end`, and its
/// states there and at the samples are in their boxes.
struct ValidatedRun {
  ValidatedStatus status = ValidatedStatus::ok;  ///< how it ended
  std::string reason;                            ///< a sentence, where the status is not ok
  StateBox end;                                  ///< at the duration, or where the run stopped
  std::vector<StateBox> samples;                 ///< at the multiples asked for, and at the end
  /// Of the states at the end by those at the start, row after row, for every start; where they
  /// were asked for.
  std::vector<RationalInterval> derivatives;
  std::vector<std::string> contracted_by;  ///< the integrals that have made it smaller
  unsigned long long steps = 0;            ///< that were made
  unsigned long long rejected = 0;         ///< that could not be enclosed at their length
  double seconds = 0;                      ///< that the run took
  /// All zeros of s up to the time `crossings_until`, in the order of the run: none is missed, and
  /// none is there twice. One at the start itself is not among them.
  std::vector<ValidatedCrossing> crossings;
  cln::cl_RA crossings_until = 0;  ///< that of `end`, where the status is ok
  bool starts_on_plane = false;    ///< s may be zero at the start

  /// The largest half width of the box at the end.
  double radius() const;
};

/// Encloses the solutions of an initial value problem by Taylor series in balls and Lohner's
/// method: see `runtime/validated`. \throws std::domain_error  where the data have no value.
/// \throws std::invalid_argument  where the numbers of states of its parts differ.
ValidatedRun validated_run(const ValidatedProblem& problem, const ValidatedSettings& settings);

}  // namespace casimir
