#pragma once

#include <vector>

#include "codegen/dag/expression_dag.hpp"
#include "runtime/program.hpp"

namespace casimir::codegen {

/// The outputs of a program in the normal form of a Dag, where input i is symbol i. Sums within
/// sums and products within products become one, and what is equal or cancels there is found.
/// \throws ModelError  where a constant is not a real number.
std::vector<Scaled> lifted(Dag& dag, const Program& program);

}  // namespace casimir::codegen
