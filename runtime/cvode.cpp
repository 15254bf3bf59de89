#include "runtime/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

namespace casimir {
namespace {

/// What CVODE's callbacks need.
struct Problem {
  const ModuleFunctions* functions;
  const double* parameters;
  unsigned long long jacobians = 0;
};

int rhs(realtype t, N_Vector y, N_Vector dy, void* data) {
  const auto* problem = static_cast<const Problem*>(data);
  problem->functions->rhs(t, N_VGetArrayPointer(y), problem->parameters, N_VGetArrayPointer(dy));
  for (sunindextype i = 0; i < N_VGetLength(dy); ++i) {
    if (!std::isfinite(NV_Ith_S(dy, i))) return 1;  // recoverable: CVODE tries a smaller step
  }
  return 0;
}

int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix j, void* data, N_Vector, N_Vector,
             N_Vector) {
  auto* problem = static_cast<Problem*>(data);
  ++problem->jacobians;
  problem->functions->jacobian(t, N_VGetArrayPointer(y), problem->parameters, SM_DATA_D(j));
  return 0;
}

/// The objects of one CVODE run.
class Solver {
 public:
  Solver(const Module& module, const Method& method, const Settings& settings, Problem& problem,
         const std::vector<double>& initial) {
    const bool stiff = method.name == "cvode-bdf";
    SUNContext raw = nullptr;
    if (SUNContext_Create(nullptr, &raw) != 0) throw std::bad_alloc();
    context_.reset(raw);
    state_.reset(N_VNew_Serial(static_cast<sunindextype>(initial.size()), raw));
    std::copy(initial.begin(), initial.end(), N_VGetArrayPointer(state_.get()));
    memory_ = CVodeCreate(stiff ? CV_BDF : CV_ADAMS, raw);
    if (memory_ == nullptr) throw std::bad_alloc();
    CVodeSetErrHandlerFn(
        memory_, [](int, const char*, const char*, char*, void*) {}, nullptr);
    CVodeInit(memory_, rhs, 0, state_.get());
    CVodeSStolerances(memory_, settings.rtol, settings.atol);
    CVodeSetUserData(memory_, &problem);
    CVodeSetMaxNumSteps(memory_, -1);
    CVodeSetStopTime(memory_, settings.duration);
    if (!stiff) {
      iteration_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, raw));
      CVodeSetNonlinearSolver(memory_, iteration_.get());
      return;
    }
    const auto n = static_cast<sunindextype>(initial.size());
    matrix_.reset(SUNDenseMatrix(n, n, raw));
    linear_.reset(SUNLinSol_Dense(state_.get(), matrix_.get(), raw));
    CVodeSetLinearSolver(memory_, linear_.get(), matrix_.get());
    if (module.functions().jacobian != nullptr) CVodeSetJacFn(memory_, jacobian);
  }
  ~Solver() { CVodeFree(&memory_); }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void* memory() { return memory_; }
  N_Vector state() { return state_.get(); }
  SUNContext context() { return context_.get(); }

 private:
  struct Free {
    void operator()(SUNContext c) const { SUNContext_Free(&c); }
    void operator()(N_Vector v) const { N_VDestroy(v); }
    void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
    void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

  Owned<SUNContext> context_;
  Owned<N_Vector> state_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> linear_;
  Owned<SUNNonlinearSolver> iteration_;
  void* memory_ = nullptr;
};

bool all_finite(const double* x, std::ptrdiff_t n) {
  return std::all_of(x, x + n, [](double v) { return std::isfinite(v); });
}

/// Like the kernels: a run that can go no further at a place where the solution changes by its own
/// size in a vanishing part of the time passed has met a singularity.
Status status_of(int flag, const Problem& problem, const Trajectory& trajectory) {
  std::vector<double> slope(trajectory.state.size());
  problem.functions->rhs(trajectory.time, trajectory.state.data(), problem.parameters,
                         slope.data());
  double size = 0, speed = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    size = std::max(size, std::abs(trajectory.state[i]));
    speed = std::max(speed, std::abs(slope[i]));
  }
  constexpr double kVanishing = 1e-6;
  if (size < kVanishing * speed * std::abs(trajectory.time)) return Status::singularity;
  switch (flag) {
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      return Status::non_finite;
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL:
      return Status::no_convergence;
    default:
      return Status::step_underflow;
  }
}

void read_counts(void* memory, Trajectory& trajectory) {
  long steps = 0;
  long failures = 0;
  long evaluations = 0;
  CVodeGetNumSteps(memory, &steps);
  CVodeGetNumErrTestFails(memory, &failures);
  CVodeGetNumRhsEvals(memory, &evaluations);
  long for_jacobian = 0;
  CVodeGetNumLinRhsEvals(memory, &for_jacobian);  // leaves zero where there is no linear solver
  trajectory.steps = static_cast<unsigned long long>(steps);
  trajectory.rejected = static_cast<unsigned long long>(failures);
  trajectory.evaluations = static_cast<unsigned long long>(evaluations + for_jacobian);
}

}  // namespace

void integrate_with_cvode(const Module& module, const Method& method, const Settings& settings,
                          const double* parameters, Observer& observer, Trajectory& trajectory) {
  Problem problem{&module.functions(), parameters};
  const auto n = static_cast<std::ptrdiff_t>(trajectory.state.size());
  std::vector<double> slope(trajectory.state.size());
  problem.functions->rhs(0, trajectory.state.data(), parameters, slope.data());
  if (!all_finite(trajectory.state.data(), n) ||
      (settings.duration != 0 && !all_finite(slope.data(), n))) {
    trajectory.status = Status::non_finite;
    return;
  }
  Solver solver(module, method, settings, problem, trajectory.state);
  const std::unique_ptr<std::remove_pointer_t<N_Vector>, void (*)(N_Vector)> between(
      N_VClone(solver.state()), N_VDestroy);
  const double* const x = N_VGetArrayPointer(solver.state());
  const auto state_at = [&](double t, double* out) {
    CVodeGetDky(solver.memory(), t, 0, between.get());
    std::copy_n(N_VGetArrayPointer(between.get()), n, out);
  };
  const auto start = std::chrono::steady_clock::now();
  realtype t = 0;
  while (t != settings.duration) {
    if (settings.max_steps > 0 && trajectory.steps == settings.max_steps) {
      trajectory.status = Status::max_steps;
      break;
    }
    const int flag = CVode(solver.memory(), settings.duration, solver.state(), &t, CV_ONE_STEP);
    // A step that does not move the time is lost in rounding.
    if (flag < 0 || t == trajectory.time || !all_finite(x, n)) {
      trajectory.status = status_of(flag, problem, trajectory);
      break;
    }
    std::copy_n(x, n, trajectory.state.begin());
    trajectory.time = t;
    ++trajectory.steps;
    if (observer.needed() && !observer.step(t, x, state_at) && t != settings.duration) {
      trajectory.status = Status::stopped;
      break;
    }
  }
  trajectory.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  read_counts(solver.memory(), trajectory);
  trajectory.jacobians = problem.jacobians;
}

}  // namespace casimir
