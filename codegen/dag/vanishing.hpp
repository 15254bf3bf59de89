#pragma once

#include <string>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::codegen {

/// Whether the expression is zero once multiplied out. False when that is too long to try: then the
/// zero is merely computed.
bool vanishes(const Dag& dag, const Scaled& expression, std::size_t inputs);

/// A product of states whose coefficient is zero for the values of a scene.
struct VanishingTerm {
  std::string product;      ///< "M1*M2"
  std::string coefficient;  ///< "a1 - a2"
};

/// The products of states that `general` has when multiplied out and `folded` has not. Looks at
/// polynomials in the states only.
/// \param states  how many of the symbols, from the first, are states.
std::vector<VanishingTerm> vanishing_terms(Dag& dag, const Scaled& general, const Scaled& folded,
                                           std::size_t states, std::size_t inputs);

}  // namespace casimir::codegen
