#pragma once

#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen {

/// The struct `Series` for the kernel of runtime/kernels/taylor/convolved.hpp: the Taylor
/// coefficients of the solutions of x' = program, by the recurrence of each operation.
/// \param names  for each input of the program, the name of its local; the last is the time.
/// \param limits  of the constants, see `constant_value`
std::string series_struct(const Program& rhs, const std::vector<std::string>& names,
                          const Limits& limits);

/// The same for runtime/kernels/lanes/lane_convolved.hpp: one trajectory in each lane of every
/// value.
std::string lane_series_struct(const Program& rhs, const std::vector<std::string>& names,
                               const Limits& limits);

}  // namespace casimir::codegen
