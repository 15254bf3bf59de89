#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "runtime/module.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// The derivatives of a right-hand side by its states: output k of `program` is the entry in row
/// entries[k].first and column entries[k].second; what has no output is zero.
struct JacobianProgram {
  Program program;
  std::vector<std::pair<int, int>> entries;
};

/// How many states the interpreted methods for stiff systems have room for.
inline constexpr std::size_t kMostInterpretedStiff = 51;

/// Integrates by the Radau IIA methods with `stages` stages, 3 or 5, with a right-hand side and a
/// Jacobian that are interpreted: the same steps as those of compiled code but for rounding, and
/// several times slower.
/// \throws std::invalid_argument  for another number of stages, or more states than there is room
///                                for.
std::function<ModuleFunctions::Integration> interpreted_radau(const Program& rhs,
                                                              const JacobianProgram& jacobian,
                                                              int stages);

}  // namespace casimir
