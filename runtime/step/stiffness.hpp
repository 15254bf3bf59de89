#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/module.hpp"

namespace casimir {

/// The rates, per unit of time, that tell whether an explicit method is held up.
struct Rates {
  double decay = 0;     ///< at which the fastest decaying perturbation dies out: max -Re(lambda)
  double solution = 0;  ///< at which the solution changes: |dx/dt| / |x| in the largest norm
};

/// The rates at a state, from the eigenvalues of the Jacobian: the module's where it has one, else
/// of central differences of its right-hand side. Costs a few evaluations and n^3 operations.
/// \param p  the run-time parameters, or null if there are none.
/// \return   nothing where the right-hand side or the Jacobian is not finite.
std::optional<Rates> rates_at(const Module& module, double t, const std::vector<double>& x,
                              const double* p);

/// Whether an explicit method would spend its steps on stability rather than on accuracy: within
/// the time `span` a perturbation dies out a thousand times over, and a hundred times faster than
/// the solution changes. In a fast transient the answer is no: ask again behind it.
bool is_stiff(const Module& module, double t, const std::vector<double>& x, const double* p,
              double span);

/// Why a run with steps of about the size `step` got no further, if it was for stability: the
/// step is of the order of the fastest decay time or beyond, and short against the time in which
/// the solution changes.
/// \return  a sentence that names the rates and the way out, or nothing.
std::optional<std::string> stiffness_at(const Module& module, double t,
                                        const std::vector<double>& x, const double* p, double step);

}  // namespace casimir
