#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "runtime/methods.hpp"
#include "runtime/module.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// How an integration ended.
enum class Status {
  ok,
  singularity,
  non_finite,
  step_underflow,
  max_steps,
  no_convergence,
  drift_exceeded,
  stopped,
  at_jump,  ///< the motion stays where a sign jumps
};

/// "ok", "singularity", ..: as the interface spells them.
std::string to_string(Status status);

/// Values and sizes of the invariants, one of each: see Settings.
using InvariantTerms =
    std::function<void(double t, const double* x, long double* values, long double* sizes)>;

/// A step that is taken.
struct TakenStep {
  double t0, t1;
  const double* x0;                                   ///< where it began
  std::function<void(double t, double* x)> state_at;  ///< writes the state at a time within it
};

/// What becomes of the state at the end of a step.
enum class StepChange {
  none,
  changed,  ///< the run goes on from the state that is now there
  unknown   ///< the run ends as `no_convergence`
};

/// May change x, the state at the end of the step.
using AfterStep = std::function<StepChange(const TakenStep& step, double* x)>;

/// What a run shall be like, and what it is watched by.
struct Settings {
  double begin = 0;     ///< the time at the start; 0 for other libraries' methods
  double duration = 0;  ///< from there; may be negative: backwards in time
  double rtol = 1e-10;  ///< local error per component: atol + rtol |x_i|
  double atol = 1e-12;
  double fixed_step = 0;  ///< > 0: constant step, no error control
  /// > 0: a method of our own begins anew after this time, so that its steps are others than those
  /// of a run without.
  double begin_anew = 0;
  /// Steps end so many times as far behind the branches of |u|, sign(u) and angles.
  double land_further = 1;
  double longest_step = 0;           ///< > 0: of a method of CVODE
  unsigned long long max_steps = 0;  ///< 0: no limit
  double sample_every = 0;           ///< > 0: states at these times, from the dense output
  bool monitor = true;               ///< follow the invariants at every step
  /// Writes for each invariant its value at a state and the size of its largest term, so that
  /// drift is not measured against a zero. Called at the start, after 1, 2, 4, 8, .. steps and at
  /// the end; and after every step where values or sizes leave the range of double.
  InvariantTerms invariant_terms;
  /// If set, the program of the invariants, with the inputs of a right-hand side: those with angles
  /// in them, which have many values, are followed on one branch. Must outlive the run.
  const Program* invariants = nullptr;
  /// If set, told after each step how far each invariant is from its first value: |I(t) - I(0)|.
  std::function<void(double t, const double* changes)> invariant_changes = {};
  /// If set and monitored, shown the state after each step.
  std::function<void(double t, const double* x)> watch = {};
  /// As `watch`, but shown the step as a whole: `state_at` writes the state at a time within it.
  std::function<void(double t, const double* x,
                     const std::function<void(double t, double* x)>& state_at)>
      watch_within = {};
  /// If set, shown the state and its carry at the end of each step, which it may change, before the
  /// step is accepted: see Projector. For our own methods only.
  std::function<void(double t, double* x, double* carry)> project = {};
  /// If set, shown each step, the state at whose end it may change. For our own methods only.
  AfterStep after_step = {};
  std::function<void(double t)> progress = {};  ///< if set, told the time after each step
  std::function<bool()> give_up;  ///< asked after each step; true ends the run as `stopped`
};

/// How an invariant fared along a run.
struct InvariantRecord {
  long double initial = 0;  ///< may be beyond the range of double
  long double final = 0;    ///< on the branch of `initial`, where the angles in it were followed
  double drift = 0;  ///< largest |I(t) - I(0)| after any step / max(|I(0)|, size of its terms)
  /// What the tolerance allows the drift to be: what the steps of the run can do together if each
  /// makes the local error allowed to it in every state, with a margin. Infinite where there is no
  /// error control.
  double allowed = std::numeric_limits<double>::infinity();
};

/// What came of a run. Where it stopped early, `time` and `state` are those of the last good step.
struct Trajectory {
  Status status = Status::ok;
  std::string reason;  ///< a sentence, where the status is not ok
  bool stiff = false;  ///< an explicit method got no further because the equations are stiff
  double time = 0;
  std::vector<double> state;
  std::vector<double> sizes;  ///< largest |x_i| after any step; at both ends, if not monitored
  std::vector<double> sample_times;
  std::vector<std::vector<double>> samples;
  std::vector<InvariantRecord> invariants;
  unsigned long long steps = 0, rejected = 0, evaluations = 0, jacobians = 0;
  double seconds = 0;  ///< of the integration alone
};

/// Integrates.
/// \param module  with the method's kernel, or with only the right-hand side for a method of
///     another library.
/// \param initial  one number for each state.
/// \throws std::invalid_argument  for tolerances that are not positive or below what double
///                    precision can give, a duration that is not finite, wrong sizes.
Trajectory integrate(const Module& module, const Method& method, const Settings& settings,
                     const std::vector<double>& initial,
                     const std::vector<double>& parameters = {});

/// \throws std::invalid_argument  for tolerances, a duration, steps or samples that `integrate`
///                                would refuse.
void check_settings(const Settings& settings, const Method& method);

/// What a kernel's `enum casimir_status` means.
Status status_of(int status);

/// A sentence, for whatever is not ok.
std::string reason_of(Status status);

/// The least relative tolerance that double precision can give a meaning.
inline constexpr double kLeastTolerance = 1e-15;

}  // namespace casimir
