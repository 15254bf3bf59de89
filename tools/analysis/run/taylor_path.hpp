#pragma once

#include <optional>
#include <vector>

#include "runtime/module.hpp"
#include "runtime/program.hpp"
#include "runtime/taylor/quadratic_form.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

/// Where the Taylor coefficients of one trajectory come from. runtime/README.md has the map of all
/// kernels.
enum class TaylorPath {
  tables,       ///< a precompiled kernel, driven by the tables of a quadratic right-hand side
  compiled,     ///< code written for this right-hand side
  interpreted,  ///< its straight-line program, line by line
};

/// The path of a right-hand side at these parameters, and what it needs.
struct TaylorChoice {
  TaylorPath path = TaylorPath::interpreted;
  std::optional<QuadraticForm> form;  ///< where `path` is `tables`
};

/// Tables where the right-hand side is quadratic, a precompiled kernel has room for it, and writing
/// it out as a sum of products loses nothing; else what the compiler makes if there may be one,
/// else the interpreter.
/// \param limits  of the numbers in it: those of the specialisation
TaylorChoice choose_taylor_path(const Program& rhs, const Limits& limits,
                                const std::vector<double>& parameters, bool may_compile);

/// A module that needs no compiler: by tables, or interpreted. It serves one thread at a time, and
/// by tables these parameters only.
/// \param limits  as above
Module taylor_module_without_compiler(const Program& rhs, const Limits& limits,
                                      const Program& invariants,
                                      const std::vector<double>& parameters);

}  // namespace casimir
