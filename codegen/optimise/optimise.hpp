#pragma once

#include <string>
#include <vector>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/optimise/differentiate.hpp"
#include "codegen/optimise/lower.hpp"
#include "runtime/program.hpp"

namespace casimir::codegen {

/// A program with few operations that computes the expressions.
///
/// Tries the structure as the file has it and, while it is not too long, its expansion; each is
/// factored in several ways and the cheapest by `weight` wins. On a tie the structure stays. All
/// candidates are the same functions exactly.
/// \param inputs  one name for each symbol of the Dag: input i is symbol i.
/// \param outputs  one name for each expression.
Program optimised(const Dag& dag, const std::vector<Scaled>& expressions,
                  const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// The same for programs that are written already. All compute the same functions: each is a place
/// to start from, as it stands and lifted into the Dag, and the result is never longer than the
/// shortest of them.
Program optimised(Dag& dag, const std::vector<Program>& programs);

/// The same for matrices. Entries that vanish identically are left out.
SparseProgram optimised(Dag& dag, const std::vector<SparseProgram>& programs);

}  // namespace casimir::codegen
