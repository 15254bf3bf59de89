#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::tools {

/// Puts a symbol for M1*g1 + M2*g2 + M3*g3 wherever the three terms stand in one sum with the same
/// factor beside them. Nothing is expanded, and what is left has the value of what was there.
class ScalarProducts {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;

  /// Borrows the dag.
  /// \param vectors  the symbols of the components, as indices into those of the dag.
  /// \param symbols  the symbol for the product of two vectors; pairs without one are left alone.
  ScalarProducts(codegen::Dag& dag, std::vector<std::array<int, 3>> vectors,
                 std::map<Pair, int> symbols);

  codegen::Scaled in(const codegen::Scaled& expression);

  /// The vectors that were found in a product so far.
  const std::set<std::size_t>& used() const { return used_; }

 private:
  codegen::Scaled in_sum(std::vector<codegen::Scaled> terms);
  bool replace_one(std::vector<codegen::Scaled>& terms, const Pair& pair, int symbol);
  std::vector<std::size_t> partners(const std::vector<codegen::Scaled>& terms, std::size_t first,
                                    const Pair& pair, codegen::Scaled& cofactor);
  cln::cl_RA exponent(const codegen::Scaled& term, codegen::NodeId node) const;

  codegen::Dag& dag_;
  std::vector<std::array<int, 3>> vectors_;
  std::map<Pair, int> symbols_;
  std::set<std::size_t> used_;
};

}  // namespace casimir::tools
