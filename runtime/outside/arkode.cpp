#include "runtime/outside/arkode.hpp"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "runtime/outside/sundials.hpp"

namespace casimir {
namespace {

using sundials::Owned;
using sundials::Problem;

/// Whether a step failed because the right-hand side had no value somewhere in it.
bool no_value(int flag) {
  return flag == ARK_RHSFUNC_FAIL || flag == ARK_FIRST_RHSFUNC_ERR ||
         flag == ARK_REPTD_RHSFUNC_ERR || flag == ARK_UNREC_RHSFUNC_ERR;
}

/// The objects of one ARKODE run.
class Solver {
 public:
  Solver(const Settings& settings, Problem& problem, double begin, double end,
         const std::vector<double>& initial)
      : context_(sundials::new_context()), state_(sundials::new_vector(initial, context_.get())) {
    memory_ = ERKStepCreate(sundials::rhs, begin, state_.get(), context_.get());
    if (memory_ == nullptr) throw std::bad_alloc();
    ERKStepSetErrHandlerFn(memory_, sundials::keep_quiet, nullptr);
    ERKStepSetTableNum(memory_, ARKODE_FEHLBERG_13_7_8);
    ERKStepSStolerances(memory_, settings.rtol, settings.atol);
    ERKStepSetUserData(memory_, &problem);
    ERKStepSetMaxNumSteps(memory_, -1);
    // The library's interpolation is of order 5 at most, and keeping it up costs time at every
    // step.
    ERKStepSetInterpolantDegree(memory_, 1);
    ERKStepSetStopTime(memory_, end);
  }
  ~Solver() { ERKStepFree(&memory_); }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  const double* x() { return N_VGetArrayPointer(state_.get()); }
  int evolve(double end, realtype* t, int task) {
    return ERKStepEvolve(memory_, end, state_.get(), t, task);
  }

  /// One step from `t` and `x`. The library gives up where a stage has no value, although a shorter
  /// step may have one: tries tenths of it.
  int step(double end, realtype* t, const std::vector<double>& x) {
    const double begin = *t;
    int flag = evolve(end, t, ARK_ONE_STEP);
    realtype h = 0;
    ERKStepGetCurrentStep(memory_, &h);
    while (no_value(flag) && std::abs(h) > kSmallest * std::abs(begin)) {
      h /= 10;
      restart(begin, end, x, h);
      *t = begin;
      flag = evolve(end, t, ARK_ONE_STEP);
    }
    return flag;
  }

  void read_counts(Trajectory& trajectory) {
    add_counts();
    trajectory.steps = static_cast<unsigned long long>(steps_);
    trajectory.rejected = static_cast<unsigned long long>(failures_);
    trajectory.evaluations = static_cast<unsigned long long>(evaluations_);
  }

 private:
  /// Of the time: a shorter step is lost in rounding.
  static constexpr double kSmallest = 1e-15;

  void restart(double begin, double end, const std::vector<double>& x, double h) {
    add_counts();
    std::copy(x.begin(), x.end(), N_VGetArrayPointer(state_.get()));
    ERKStepReInit(memory_, sundials::rhs, begin, state_.get());
    ERKStepSetStopTime(memory_, end);
    ERKStepSetInitStep(memory_, h);
  }

  /// The library counts anew after each restart.
  void add_counts() {
    long steps = 0;
    long failures = 0;
    long evaluations = 0;
    ERKStepGetNumSteps(memory_, &steps);
    ERKStepGetNumErrTestFails(memory_, &failures);
    ERKStepGetNumRhsEvals(memory_, &evaluations);
    steps_ += steps;
    failures_ += failures;
    evaluations_ += evaluations;
  }

  Owned<SUNContext> context_;
  Owned<N_Vector> state_;
  void* memory_ = nullptr;
  long steps_ = 0, failures_ = 0, evaluations_ = 0;
};

Status meaning(int flag) { return no_value(flag) ? Status::non_finite : Status::step_underflow; }

}  // namespace

void integrate_with_arkode(const Module& module, const Settings& settings, const double* parameters,
                           Observer& observer, Trajectory& trajectory) {
  Problem problem{&module.functions(), parameters};
  if (!sundials::starts_well(problem, settings, trajectory) || settings.duration == 0) return;
  Solver solver(settings, problem, 0, settings.duration, trajectory.state);
  // Where the last step began, for the states inside it.
  std::vector<double> before = trajectory.state;
  double before_time = 0;
  const bool sampled = settings.sample_every > 0;
  const sundials::Stepper stepper{[&](realtype* t) {
                                    if (sampled) {
                                      before = trajectory.state;
                                      before_time = trajectory.time;
                                    }
                                    return solver.step(settings.duration, t, trajectory.state);
                                  },
                                  [&](double t, double* x) {
                                    Solver inside(settings, problem, before_time, t, before);
                                    realtype reached = before_time;
                                    if (t != before_time) inside.evolve(t, &reached, ARK_NORMAL);
                                    std::copy_n(inside.x(), before.size(), x);
                                  },
                                  meaning};
  sundials::integrate(problem, settings, observer, trajectory, solver.x(), stepper);
  solver.read_counts(trajectory);
}

}  // namespace casimir
