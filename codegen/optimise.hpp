#pragma once

#include <string>
#include <vector>

#include "codegen/canonical.hpp"
#include "codegen/lower.hpp"
#include "runtime/program.hpp"

namespace casimir::codegen {

/// A program with few operations that computes the expressions.
///
/// Tries the structure as the file has it and, while it is not too long, its expansion; each is
/// factored in several ways and the cheapest by `weight` wins. On a tie the structure stays. All
/// candidates are the same functions exactly.
/// \param inputs   one name for each symbol of the Dag: input i is symbol i.
/// \param outputs  one name for each expression.
Program optimised(const Dag& dag, const std::vector<Scaled>& expressions,
                  const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace casimir::codegen
