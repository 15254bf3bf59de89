#pragma once

#include "runtime/integrate.hpp"
#include "runtime/step/observer.hpp"

namespace casimir {

/// Integrates with CVODE of SUNDIALS: "cvode-adams" with functional iteration, "cvode-bdf" with
/// Newton's method, a dense matrix and the module's Jacobian where it has one. Fills in status,
/// time, state and counts; `observer` sees every step.
void integrate_with_cvode(const Module& module, const Method& method, const Settings& settings,
                          const double* parameters, Observer& observer, Trajectory& trajectory);

}  // namespace casimir
