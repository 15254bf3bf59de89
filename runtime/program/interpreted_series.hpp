#pragma once

#include <functional>

#include "runtime/module.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// Integrates by Taylor series whose coefficients come from a program line by line: several times
/// slower than compiled code, but for every system and without a compiler.
std::function<ModuleFunctions::Integration> interpreted(const Program& rhs, std::size_t parameters);

}  // namespace casimir
