#pragma once

// What the integrators of SUNDIALS share. Private to the runtime.

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "runtime/integrate.hpp"
#include "runtime/step/observer.hpp"

namespace casimir::sundials {

struct Free {
  void operator()(SUNContext c) const { SUNContext_Free(&c); }
  void operator()(N_Vector v) const { N_VDestroy(v); }
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

/// \throws std::bad_alloc
Owned<SUNContext> new_context();
Owned<N_Vector> new_vector(const std::vector<double>& values, SUNContext context);

/// What the callbacks need.
struct Problem {
  const ModuleFunctions* functions;
  const double* parameters;
  unsigned long long jacobians = 0;
};

/// Calls the compiled right-hand side. A value that is no number is answered by 1: the library is
/// to try a smaller step.
int rhs(realtype t, N_Vector y, N_Vector dy, void* problem);

/// For the libraries' error messages, which go nowhere: every outcome is in the status.
void keep_quiet(int, const char*, const char*, char*, void*);

/// An integrator of the library, as the loop below sees it.
struct Stepper {
  /// One step towards the end of the run; writes the time. A negative answer is a failure.
  std::function<int(realtype* t)> step;
  /// The state at a time inside the last step.
  std::function<void(double t, double* x)> state_at;
  /// What a negative answer of `step` means, where it is no singularity.
  std::function<Status(int flag)> meaning;
};

/// Makes the stepper and steps to the end. Fills in status, time, state, steps and seconds;
/// `observer` sees every step. Without a number at the start nothing is made.
void integrate(const Problem& problem, const Settings& settings, Observer& observer,
               Trajectory& trajectory, const double* x, const Stepper& stepper);

/// Whether the start and the slope there are finite; if not, the status says so.
bool starts_well(const Problem& problem, const Settings& settings, Trajectory& trajectory);

}  // namespace casimir::sundials
