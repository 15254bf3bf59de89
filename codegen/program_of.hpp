#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// The values of expressions as a program: inputs are the symbols in their order, outputs f0, f1,
/// ..
/// \throws ModelError  for what is not real and exact, and for symbols that are no inputs
Program program_of(const std::vector<GiNaC::ex>& functions,
                   const std::vector<GiNaC::symbol>& inputs);

}  // namespace casimir
