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

namespace casimir {
namespace {

/// What CVODE's callbacks need.
struct Problem {
  const ModuleFunctions* functions;
  const double* parameters;
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
  const auto* problem = static_cast<const Problem*>(data);
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

Status status_of(int flag) {
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
  trajectory.steps = static_cast<unsigned long long>(steps);
  trajectory.rejected = static_cast<unsigned long long>(failures);
  trajectory.evaluations = static_cast<unsigned long long>(evaluations);
}

}  // namespace

void integrate_with_cvode(const Module& module, const Method& method, const Settings& settings,
                          const double* parameters, Observer& observer, Trajectory& trajectory) {
  Problem problem{&module.functions(), parameters};
  Solver solver(module, method, settings, problem, trajectory.state);
  const std::unique_ptr<std::remove_pointer_t<N_Vector>, void (*)(N_Vector)> between(
      N_VClone(solver.state()), N_VDestroy);
  const double* const x = N_VGetArrayPointer(solver.state());
  const auto n = static_cast<std::ptrdiff_t>(trajectory.state.size());
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
    const bool finite = std::all_of(x, x + n, [](double v) { return std::isfinite(v); });
    if (flag < 0 || !finite) {
      trajectory.status = flag < 0 ? status_of(flag) : Status::non_finite;
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
}

}  // namespace casimir
