#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/kernels/quadratic_tables.h"
#include "runtime/module.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// The instruction sets that have a table-driven kernel of their own here, the widest that this
/// processor runs first: some of "avx512", "avx2", "baseline". Never empty.
std::vector<std::string> quadratic_targets();

/// The table-driven kernel for an instruction set.
/// \throws std::invalid_argument  if this processor does not run it.
void integrate_quadratic(const std::string& target, const casimir_quadratic& tables,
                         const casimir_run* run, double* x, casimir_outcome* out);

/// A module made without a compiler: right-hand side and invariants are interpreted, and Taylor
/// series come from a precompiled kernel where there are tables, else from the program line by
/// line. One module serves one thread at a time.
/// \param tables      of `rhs` at these parameters.
/// \param parameters  their values; `integrate` refuses others where there are tables.
Module uncompiled_module(const Program& rhs, const Program& invariants,
                         const std::optional<casimir_quadratic>& tables,
                         const std::vector<double>& parameters);

}  // namespace casimir
