#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "runtime/integrate.hpp"

namespace casimir {

/// The state that runs should end in.
struct ReferenceState {
  std::vector<double> state;  ///< the reference rounded to double
  std::vector<double> rest;   ///< the reference less `state`
  std::vector<double> scale;  ///< of each state: its size over the run; not zero
};

/// Max over the states of the truth of |x - truth| / scale; infinity where x is no number.
/// \param which  for each state of the truth its place in `x`; empty: the same states.
double error_of(const std::vector<double>& x, const ReferenceState& truth,
                std::span<const int> which = {});

/// A method at one tolerance on one module: what is measured against its like.
struct Entrant {
  const Module* module;
  const Method* method;
  Settings settings;
  std::vector<double> initial, parameters;
  std::vector<int> which;  ///< see `error_of`
};

/// The error of a run beside its time. A time without an error is not reported.
struct Sample {
  Status status = Status::ok;
  std::string refused = {};  ///< why the run was not begun, or empty
  bool too_slow = false;     ///< not run to its end, or not begun, because of Plan::longest_run
  double error = 0;          ///< see `error_of`; not a number where the end was not reached
  double drift = 0;          ///< the largest of all invariants
  double seconds = 0;        ///< of the integration alone: median over the rounds, after a warm-up
  double spread = 0;         ///< half the distance of the quartiles
  int rounds = 0;            ///< in which it was timed
  unsigned long long steps = 0, evaluations = 0;
};

/// How much is measured.
struct Plan {
  double budget = 8;         ///< seconds for the timed rounds of all entrants together
  int rounds = 0;            ///< > 0: that many rounds for everybody, whatever it costs
  double longest_run = 0.2;  ///< seconds of the processor; what takes longer is given up, and so is
                             ///< whatever follows it with the same method on the same module
  std::function<bool()> give_up = {};  ///< true ends it all: `measure` throws Abandoned
  std::function<void(double share)> progress = {};  ///< told now and then what share is done
};

/// Plan::give_up said so.
struct Abandoned {};

/// Runs everybody once for error and drift, once more to warm up, and then in rounds: one turn of
/// each entrant a round, in an order drawn anew for every round, so that what disturbs the machine
/// for a while hits all alike. A turn of a short run is a batch of several after one that does not
/// count, so that neither the resolution of the clock nor cold caches matter. Time in which other
/// programs had the processor does not count. Slow entrants take part in fewer rounds, spread over
/// the whole time: at least three of them, or one for a run of a 500th of the budget, which does
/// without a warm-up too.
///
/// The error is that of the timed runs as well: where one ends elsewhere, the larger error counts.
/// \throws Abandoned
std::vector<Sample> measure(std::span<const Entrant> entrants, const ReferenceState& truth,
                            const Plan& plan);

/// How much a small change of the state, made at the start or at one of a few later times, has
/// grown at the end of the run, at most; all relative to the scales of `truth`. At least 1.
/// By differences of runs with `entrant`'s method; infinity where one of them does not arrive.
/// \param times  how many, the start among them; 1 for equations that depend on the time, which an
///               integration counts from zero.
double conditioning(const Entrant& entrant, const ReferenceState& truth, int times = 8);

/// The largest error that tolerance and rounding explain: a thousand times what arrives at the end
/// if every step does all of the harm that it may, steps * conditioning * (tolerance + 2^-52), the
/// tolerance relative to the scales of `truth`. Infinite without error control.
double explained_error(const Entrant& entrant, const Sample& sample, const ReferenceState& truth,
                       double conditioning);

}  // namespace casimir
