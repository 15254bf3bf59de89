#pragma once

#include "runtime/integrate.hpp"
#include "runtime/step/observer.hpp"

namespace casimir {

/// Integrates with ARKODE of SUNDIALS: "arkode-erk", the explicit Runge-Kutta method of Fehlberg of
/// order 8 with an embedded one of order 7, the highest that the library has, and its own choice of
/// steps. States between steps are reached by a step of the same method from the last one. Fills in
/// status, time, state and counts; `observer` sees every step.
void integrate_with_arkode(const Module& module, const Settings& settings, const double* parameters,
                           Observer& observer, Trajectory& trajectory);

}  // namespace casimir
