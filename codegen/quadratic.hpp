#pragma once

#include <optional>
#include <vector>

#include "runtime/program.hpp"
#include "runtime/taylor/quadratic_form.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

/// The polynomials that a right-hand side computes, or nothing where it is of another kind:
/// functions or quotients of states, products of three, the time. Coefficients are exact until they
/// are rounded.
/// \param limits  of the numbers in it, see `codegen::constant_value`
/// \param parameters  values of the inputs between the states and the time.
std::optional<QuadraticForm> quadratic_form(const Program& rhs, const Limits& limits,
                                            const std::vector<double>& parameters = {});

}  // namespace casimir
