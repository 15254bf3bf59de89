#pragma once

#include <optional>
#include <vector>

#include "runtime/module.hpp"
#include "runtime/program.hpp"
#include "runtime/taylor/quadratic_form.hpp"

namespace casimir {

/// A module made without a compiler: right-hand side and invariants are interpreted, and Taylor
/// series come from a precompiled kernel where it has room for the system, else from the program
/// line by line. One module serves one thread at a time.
/// \param form  what `rhs` is at these parameters; nothing: interpret.
/// \param parameters  their values; `integrate` refuses others where there is a form.
Module uncompiled_module(const Program& rhs, const Program& invariants,
                         const std::optional<QuadraticForm>& form,
                         const std::vector<double>& parameters);

}  // namespace casimir
