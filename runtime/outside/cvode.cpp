#include "runtime/outside/cvode.hpp"

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <new>

#include "runtime/outside/sundials.hpp"

namespace casimir {
namespace {

using sundials::Owned;
using sundials::Problem;

int cvode_jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix j, void* data, N_Vector, N_Vector,
                   N_Vector) {
  auto* problem = static_cast<Problem*>(data);
  ++problem->jacobians;
  problem->functions->jacobian(t, N_VGetArrayPointer(y), problem->parameters, SM_DATA_D(j));
  return 0;
}

/// The objects of one CVODE run.
class CvodeRun {
 public:
  CvodeRun(const Module& module, const Method& method, const Settings& settings, Problem& problem,
           const std::vector<double>& initial)
      : context_(sundials::new_context()), state_(sundials::new_vector(initial, context_.get())) {
    const bool stiff = method.name == "cvode-bdf";
    memory_ = CVodeCreate(stiff ? CV_BDF : CV_ADAMS, context_.get());
    if (memory_ == nullptr) throw std::bad_alloc();
    CVodeSetErrHandlerFn(memory_, sundials::keep_quiet, nullptr);
    CVodeInit(memory_, sundials::rhs, 0, state_.get());
    CVodeSStolerances(memory_, settings.rtol, settings.atol);
    CVodeSetUserData(memory_, &problem);
    CVodeSetMaxNumSteps(memory_, -1);
    CVodeSetStopTime(memory_, settings.duration);
    if (settings.longest_step > 0) CVodeSetMaxStep(memory_, settings.longest_step);
    if (stiff)
      use_newton(module, static_cast<sunindextype>(initial.size()));
    else
      use_functional_iteration();
  }
  ~CvodeRun() { CVodeFree(&memory_); }
  CvodeRun(const CvodeRun&) = delete;
  CvodeRun& operator=(const CvodeRun&) = delete;

  void* memory() { return memory_; }
  N_Vector state() { return state_.get(); }

 private:
  void use_functional_iteration() {
    iteration_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
    CVodeSetNonlinearSolver(memory_, iteration_.get());
  }
  void use_newton(const Module& module, sunindextype n) {
    matrix_.reset(SUNDenseMatrix(n, n, context_.get()));
    linear_.reset(SUNLinSol_Dense(state_.get(), matrix_.get(), context_.get()));
    CVodeSetLinearSolver(memory_, linear_.get(), matrix_.get());
    if (module.functions().jacobian != nullptr) CVodeSetJacFn(memory_, cvode_jacobian);
  }

  Owned<SUNContext> context_;
  Owned<N_Vector> state_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> linear_;
  Owned<SUNNonlinearSolver> iteration_;
  void* memory_ = nullptr;
};

Status status_of_cvode(int flag) {
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

void read_cvode_counts(void* memory, Trajectory& trajectory) {
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
  if (!sundials::starts_well(problem, settings, trajectory)) return;
  CvodeRun solver(module, method, settings, problem, trajectory.state);
  const Owned<N_Vector> between(N_VClone(solver.state()));
  const sundials::Stepper stepper{
      [&](realtype* t) {
        return CVode(solver.memory(), settings.duration, solver.state(), t, CV_ONE_STEP);
      },
      [&](double t, double* x) {
        CVodeGetDky(solver.memory(), t, 0, between.get());
        std::copy_n(N_VGetArrayPointer(between.get()), N_VGetLength(between.get()), x);
      },
      status_of_cvode};
  sundials::integrate(problem, settings, observer, trajectory, N_VGetArrayPointer(solver.state()),
                      stepper);
  read_cvode_counts(solver.memory(), trajectory);
  trajectory.jacobians = problem.jacobians;
}

}  // namespace casimir
