#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/run_trace.hpp"
#include "runtime/validated_run.hpp"

namespace casimir {

/// What is wrong with a trace.
enum class TraceFault {
  none,          ///< nothing: the run is proved
  shape,         ///< the numbers of states, integrals and coordinates do not go together
  start,         ///< the start of the problem is not certain to be in the set at the start
  time,          ///< the steps do not lead from the start to the duration
  no_value,      ///< the equations are not certain to have a value on the set
  not_enclosed,  ///< a solution is not certain to stay in the rough enclosure
  frame,         ///< the frame of the next set is not certain to be regular
  outside,       ///< the flow is not certain to take the set into the next one
  level,         ///< an integral has another value in all of the set
  not_smooth,    ///< a function is not certain to be analytic on the rough enclosure
  end,           ///< the last set is not in the box at the end
  stopped,       ///< `give_up` said so
};

/// What `check_trace` found.
struct TraceCheck {
  TraceFault fault = TraceFault::none;  ///< none: all of it is proved
  std::size_t step = 0;                 ///< the number of the step with the fault, from 1; 0: none
  std::vector<RationalInterval> end;    ///< the box at the end, where nothing is wrong
  std::vector<std::string> used;        ///< the integrals without which the sets would be wider
  /// The derivatives of the state at the end by that at the start, row after row, over the whole
  /// set of starts; where they were asked for.
  std::vector<RationalInterval> derivatives;
};

/// What is asked of `check_trace`.
struct TraceCheckSettings {
  bool derivatives = false;  ///< enclose them too
  /// Functions of one output, of the states and the time, that have to be analytic all along each
  /// solution, in the least: one whose derivative along solutions vanishes keeps its value then.
  std::vector<Program> smooth = {};
  std::function<bool()> give_up = {};  ///< asked before each step; true ends the check
};

/// Verifies a run step by step in Arb's arithmetic: that every solution that begins in the start of
/// the problem, within its radii, exists up to the duration and is then in the box of the trace.
/// Nothing of the trace is believed: for each step
///   - the rough enclosure D = sum_{k <= N} X_k [0, h]^k + [-R, R] of the solutions from a box X
///     around the set is proved by |x_{N+1}(D)| h^{N+1} < R (see FlowPiece::encloses),
///   - x(h) lies in sum m_k h^k + x_{N+1}(D) h^{N+1} + (sum V_k h^k) (x - m), by the mean value
///     theorem, with Taylor coefficients m_k at the middle and V_k of the derivatives over X,
///   - that is brought into the coordinates of the next set by an enclosed inverse of its frame,
///   and
///     bounded by the integrals, of which it is for the caller to prove that they are some,
///   - and what comes out is in the next set.
/// The right-hand side and its derivatives are the programs of the problem; the recurrences, the
/// step and the bounds are written for this alone (`runtime/certificate`).
/// \throws std::invalid_argument  for a number that is none.
TraceCheck check_trace(const ValidatedProblem& problem, const RunTrace& trace,
                       const TraceCheckSettings& settings = {});

/// The box around the last set of a trace, in doubles: what `RunTrace::end` has to contain.
/// \param problem  that the trace is of.
std::vector<std::array<std::string, 2>> end_of(const ValidatedProblem& problem,
                                               const RunTrace& trace);

}  // namespace casimir
