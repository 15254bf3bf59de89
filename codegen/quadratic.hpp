#pragma once

#include <optional>
#include <vector>

#include "runtime/program.hpp"
#include "runtime/taylor/quadratic_form.hpp"

namespace casimir {

/// The polynomials that a right-hand side computes, or nothing where it is of another kind:
/// functions or quotients of states, products of three, the time. Coefficients are exact until they
/// are rounded.
/// \param parameters  values of the inputs between the states and the time.
std::optional<QuadraticForm> quadratic_form(const Program& rhs,
                                            const std::vector<double>& parameters = {});

}  // namespace casimir
