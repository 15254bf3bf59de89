#include "runtime/integrate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "runtime/methods.hpp"
#include "runtime/outside/arkode.hpp"
#include "runtime/outside/cvode.hpp"
#include "runtime/step/observer.hpp"
#include "runtime/step/passage.hpp"
#include "runtime/step/step_look.hpp"
#include "runtime/step/stiffness.hpp"
#include "runtime/taylor/program_leading.hpp"

namespace casimir {
namespace {

using Clock = std::chrono::steady_clock;

/// More samples than this are a mistake, and would fill the memory.
constexpr double kMostSamples = 1e8;

/// Eigen's dense factorisations behind the C interface of the kernels.
struct DenseSolver {
  struct Factors {
    Eigen::PartialPivLU<Eigen::MatrixXd> lu;
    Eigen::VectorXd work;
  };
  std::array<Factors, CASIMIR_MATRICES> all;

  static Factors& factors(void* self, int which) {
    return static_cast<DenseSolver*>(self)->all[static_cast<std::size_t>(which)];
  }
  static int factor(void* self, int which, int n, const double* matrix) {
    auto& lu = factors(self, which).lu;
    lu.compute(Eigen::Map<const Eigen::MatrixXd>(matrix, n, n));
    const auto diagonal = lu.matrixLU().diagonal();
    return diagonal.allFinite() && (diagonal.array() != 0).all() ? 0 : 1;
  }
  static void solve(void* self, int which, double* b) {
    auto& [lu, work] = factors(self, which);
    Eigen::Map<Eigen::VectorXd> right(b, lu.rows());
    work.noalias() = lu.permutationP() * right;
    lu.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(work);
    lu.matrixLU().triangularView<Eigen::Upper>().solveInPlace(work);
    right = work;
  }
};

int observe(void* data, const casimir_step* step) {
  const auto state_at = [step](double t, double* x) { step->dense(step, t, x); };
  return static_cast<Observer*>(data)->step(step->t1, step->x1, state_at) ? 0 : 1;
}

void project(void* data, double t, double* x, double* carry) {
  (*static_cast<decltype(Settings::project)*>(data))(t, x, carry);
}

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument(text); }

void check_sizes(const Module& module, std::size_t states, std::size_t parameters) {
  if (states != static_cast<std::size_t>(module.dimension()))
    refuse("the initial state has the wrong number of entries");
  if (parameters != static_cast<std::size_t>(module.functions().parameter_count))
    refuse("the wrong number of parameters");
}

/// Whether a run by Taylor series ended where there may be none though the solution goes on. Not
/// one that has made no headway in a million steps.
bool may_be_passed(const casimir_run& run, const casimir_outcome& outcome) {
  constexpr unsigned long long kMostTrials = 1ULL << 19;
  const bool stuck = outcome.status == CASIMIR_NON_FINITE ||
                     outcome.status == CASIMIR_SINGULARITY ||
                     outcome.status == CASIMIR_STEP_UNDERFLOW;
  return stuck && !(run.fixed_step > 0) && !run.project &&
         outcome.steps + outcome.rejected < kMostTrials;
}

/// One run of the kernel, and where the method of Taylor series stops, over the places at which the
/// equations have no derivative.
/// \param look  null where nobody looks at steps. At a pole the solution ends, whatever lies behind.
void run_on(const Module& module, const Method& method, casimir_run run, const StepLook* look,
            double* x, casimir_outcome& outcome) {
  module.functions().integrate(&run, x, &outcome);
  if (!method.series) return;
  const double whole = run.t_end - run.t_begin;
  const auto most_steps = run.max_steps;  // of all parts together
  constexpr int kMostPassages = 100;
  // Behind the place a series reaches as far as the place is away: it need not be far.
  constexpr double kPart = 0x1p-10;
  for (int k = 0; k < kMostPassages && may_be_passed(run, outcome); ++k) {
    if (look && look->at_pole()) return;
    Passage passage([&](double t, const double* at,
                        double* rates) { module.functions().rhs(t, at, run.parameters, rates); },
                    run, static_cast<std::size_t>(module.dimension()));
    if (most_steps > 0) {
      const auto taken = outcome.steps + outcome.rejected;
      if (taken + 1 >= most_steps) {
        outcome.status = CASIMIR_MAX_STEPS;
        return;
      }
      run.max_steps = most_steps - taken - 1;  // the passage is a step too
    }
    double t = outcome.t;
    const double rest = run.t_end - t, part = kPart * whole;
    if (!passage.pass(t, x, std::abs(rest) <= std::abs(part) ? run.t_end : t + part)) return;
    casimir_outcome behind = {.status = passage.stopped() ? CASIMIR_STOPPED : CASIMIR_OK,
                              .t = t,
                              .steps = 0,
                              .rejected = 0,
                              .evaluations = 0,
                              .jacobians = 0};
    if (!passage.stopped() && t != run.t_end) {
      run.t_begin = t;
      module.functions().integrate(&run, x, &behind);
    }
    outcome.status = behind.status;
    outcome.t = behind.t;
    outcome.steps += behind.steps + 1;
    outcome.rejected += behind.rejected;
    outcome.evaluations += behind.evaluations + passage.evaluations();
  }
}

/// Ends a run behind each step whose state somebody changes, and goes on from there.
class ChangedSteps {
 public:
  ChangedSteps(const Settings& settings, Observer& observer)
      : settings_(settings), observer_(observer) {}

  void take(casimir_run& run) {
    observed_ = run.observe != nullptr;
    run.observe = [](void* self, const casimir_step* step) {
      return static_cast<ChangedSteps*>(self)->see(*step);
    };
    run.observer = this;
  }

  void go(const Module& module, const Method& method, casimir_run run, const StepLook* look,
          std::vector<double>& x, casimir_outcome& outcome) {
    const auto most_steps = run.max_steps;
    behind_.resize(x.size());
    for (;;) {
      change_ = StepChange::none;
      stopped_ = false;
      casimir_outcome part = {};
      run_on(module, method, run, look, x.data(), part);
      outcome = {.status = part.status,
                 .t = part.t,
                 .steps = outcome.steps + part.steps,
                 .rejected = outcome.rejected + part.rejected,
                 .evaluations = outcome.evaluations + part.evaluations,
                 .jacobians = outcome.jacobians + part.jacobians};
      if (change_ == StepChange::none) return;
      x = behind_;
      if (change_ == StepChange::unknown) outcome.status = CASIMIR_NO_CONVERGENCE;
      if (change_ == StepChange::unknown || part.status != CASIMIR_STOPPED || stopped_) return;
      outcome.status = CASIMIR_OK;
      if (part.t == run.t_end) return;
      const auto taken = outcome.steps + outcome.rejected;
      if (most_steps > 0 && taken >= most_steps) {
        outcome.status = CASIMIR_MAX_STEPS;
        return;
      }
      if (most_steps > 0) run.max_steps = most_steps - taken;
      run.t_begin = part.t;
    }
  }

  /// Whether that is why the run ended.
  bool is_unknown() const { return change_ == StepChange::unknown; }

 private:
  int see(const casimir_step& step) {
    stopped_ = observed_ && observe(&observer_, &step) != 0;
    std::copy_n(step.x1, behind_.size(), behind_.data());
    change_ = settings_.after_step(
        {.t0 = step.t0,
         .t1 = step.t1,
         .x0 = step.x0,
         .state_at = [&step](double t, double* x) { step.dense(&step, t, x); }},
        behind_.data());
    return stopped_ || change_ != StepChange::none ? 1 : 0;
  }

  const Settings& settings_;
  Observer& observer_;
  std::vector<double> behind_;  ///< the state at the end of the last step, as it is then
  StepChange change_ = StepChange::none;
  bool observed_ = false, stopped_ = false;
};

void run_kernel(const Module& module, const Method& method, const Settings& s,
                const double* parameters, Observer& observer, Trajectory& trajectory) {
  DenseSolver solver;
  casimir_run run = {};
  run.t_begin = s.begin;
  run.t_end = s.begin + s.duration;
  run.parameters = parameters;
  run.rtol = s.rtol;
  run.atol = s.atol;
  run.fixed_step = s.fixed_step;
  run.max_steps = s.max_steps;
  run.observe = observer.needed() ? observe : nullptr;
  run.observer = &observer;
  run.factor = DenseSolver::factor;
  run.solve = DenseSolver::solve;
  run.solver = &solver;
  auto projection = s.project;
  if (projection) {
    run.project = project;
    run.projector = &projection;
  }
  std::optional<StepLook> look;
  if (module.watch() && (module.watch()->looks(parameters, trajectory.state.data()) ||
                         !module.watch()->signed_divisors().empty())) {
    look.emplace(*module.watch(), trajectory.state.size(), parameters, trajectory.state.data());
    look->end_before_poles();
    look->land_further(s.land_further);
    run.look = [](void* looker, const casimir_step* trial) {
      return (*static_cast<StepLook*>(looker))(*trial);
    };
    run.looker = &*look;
  }
  const StepLook* const seen = look ? &*look : nullptr;
  std::optional<ProgramLeading> exact_rates;
  casimir_leading leading = {};
  if (method.series && module.exact_rates() && s.rtol > 0 && s.rtol <= kRoundingShows) {
    exact_rates.emplace(*module.exact_rates(), parameters);
    leading = exact_rates->view();
    run.leading = &leading;
  }
  std::optional<ChangedSteps> changed;
  if (s.after_step) changed.emplace(s, observer).take(run);
  casimir_outcome outcome = {};
  const auto go = [&] {
    if (changed)
      changed->go(module, method, run, seen, trajectory.state, outcome);
    else
      run_on(module, method, run, seen, trajectory.state.data(), outcome);
  };
  const auto start = Clock::now();
  if (s.begin_anew > 0 && s.begin_anew < std::abs(s.duration)) {
    run.t_end = s.begin + std::copysign(s.begin_anew, s.duration);
    go();
    run.t_begin = run.t_end;
    run.t_end = s.begin + s.duration;
  }
  if (outcome.status == CASIMIR_OK) go();
  if (changed && changed->is_unknown())
    trajectory.reason = "it is not known how deviations pass a jump of the equations";
  trajectory.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  trajectory.status = status_of(outcome.status);
  if (trajectory.status == Status::step_underflow && look && look->at_pole())
    trajectory.status = Status::singularity;
  trajectory.time = outcome.t;
  trajectory.steps = outcome.steps;
  trajectory.rejected = outcome.rejected;
  trajectory.evaluations = outcome.evaluations;
  trajectory.jacobians = outcome.jacobians;
}

/// Where an explicit method got no further although nothing is singular.
void name_stiffness(const Module& module, const Method& method, const double* parameters,
                    Trajectory& trajectory) {
  if (method.implicit || trajectory.steps == 0) return;
  if (trajectory.status != Status::step_underflow && trajectory.status != Status::max_steps) return;
  const double step = trajectory.time / static_cast<double>(trajectory.steps);
  if (const auto why = stiffness_at(module, trajectory.time, trajectory.state, parameters, step)) {
    trajectory.stiff = true;
    trajectory.reason += "; " + *why;
  }
}

}  // namespace

Status status_of(int status) {
  switch (status) {
    case CASIMIR_OK:
      return Status::ok;
    case CASIMIR_NON_FINITE:
      return Status::non_finite;
    case CASIMIR_SINGULARITY:
      return Status::singularity;
    case CASIMIR_MAX_STEPS:
      return Status::max_steps;
    case CASIMIR_NO_CONVERGENCE:
      return Status::no_convergence;
    case CASIMIR_STOPPED:
      return Status::stopped;
    default:
      return Status::step_underflow;
  }
}

std::string reason_of(Status status) {
  switch (status) {
    case Status::ok:
      return "";
    case Status::singularity:
      return "the solution has a singularity: it grows without bound or meets a pole of the "
             "equations";
    case Status::non_finite:
      return "the state or its derivative is not a finite number";
    case Status::step_underflow:
      return "the tolerance asks for steps too short to reach the end";
    case Status::max_steps:
      return "the limit on the number of steps was reached";
    case Status::no_convergence:
      return "the implicit equations of a step could not be solved";
    case Status::drift_exceeded:
      return "an invariant drifted by more than the tolerance allows";
    case Status::stopped:
      return "the run was stopped";
    case Status::at_jump:
      return "the motion stays where a sign jumps, and the equations have no solution there";
  }
  return "";
}

void check_settings(const Settings& s, const Method& method) {
  if (!std::isfinite(s.duration)) refuse("the duration must be a finite number");
  if (!(s.rtol >= 0) || !(s.atol >= 0) || !(s.rtol + s.atol > 0) || !std::isfinite(s.rtol) ||
      !std::isfinite(s.atol)) {
    refuse("tolerances must be positive finite numbers");
  }
  if (s.rtol < kLeastTolerance && !(s.fixed_step > 0))
    refuse(
        "a relative tolerance below 1e-15 is more than double precision can give: that takes a run "
        "with more digits");
  if (!(s.fixed_step >= 0) || !std::isfinite(s.fixed_step))
    refuse("the step must be a positive finite number");
  if (s.fixed_step > 0 && !method.fixed_step_ok)
    refuse(std::string(method.name) + " has no constant step");
  if (s.project && !method.outside.empty())
    refuse(std::string(method.name) + " is another library's and cannot be projected");
  if (s.after_step && !method.outside.empty())
    refuse(
        std::string(method.name) +
        " is another library's, and does not carry deviations over the jumps of these equations");
  if (!(s.sample_every >= 0)) refuse("the time between samples must be positive");
  if (s.sample_every > 0 && !(std::abs(s.duration) / s.sample_every <= kMostSamples))
    refuse("the time between samples is so small that there would be more than 1e8 of them");
}

std::string to_string(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::singularity:
      return "singularity";
    case Status::non_finite:
      return "non_finite";
    case Status::step_underflow:
      return "step_underflow";
    case Status::max_steps:
      return "max_steps";
    case Status::no_convergence:
      return "no_convergence";
    case Status::drift_exceeded:
      return "drift_exceeded";
    case Status::stopped:
      return "stopped";
    case Status::at_jump:
      return "at_jump";
  }
  return "";
}

Trajectory integrate(const Module& module, const Method& method, const Settings& settings,
                     const std::vector<double>& initial, const std::vector<double>& parameters) {
  check_sizes(module, initial.size(), parameters.size());
  check_settings(settings, method);
  Trajectory trajectory;
  trajectory.state = initial;
  const double* const p = parameters.empty() ? nullptr : parameters.data();
  Observer observer(module, settings, p, initial);
  if (method.name == "arkode-erk") {
    integrate_with_arkode(module, settings, p, observer, trajectory);
  } else if (method.header.empty() && !method.closed_form) {
    integrate_with_cvode(module, method, settings, p, observer, trajectory);
  } else if (module.functions().integrate == nullptr) {
    throw std::invalid_argument("the module was compiled without a kernel");
  } else {
    run_kernel(module, method, settings, p, observer, trajectory);
  }
  if (trajectory.reason.empty()) trajectory.reason = reason_of(trajectory.status);
  name_stiffness(module, method, p, trajectory);
  observer.finish(trajectory);
  return trajectory;
}

}  // namespace casimir
