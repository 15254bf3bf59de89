// Dag::compare: the order of terms and factors.
#include <cln/integer.h>

#include <algorithm>

#include "codegen/dag/expression_dag.hpp"

namespace casimir::codegen {

namespace {

int order(const cln::cl_RA& a, const cln::cl_RA& b) { return cln::compare(a, b); }

}  // namespace

std::vector<Factor> Dag::factors_of(NodeId id) const {
  if (id == kOne) return {};
  if ((*this)[id].kind == NodeKind::product) return (*this)[id].factors;
  return {{id, 1}};
}

int Dag::compare(NodeId a, NodeId b) const {
  if (a == b) return 0;
  if (const int by_degree = order((*this)[b].degree, (*this)[a].degree)) return by_degree;
  const std::vector<Factor> left = factors_of(a);
  const std::vector<Factor> right = factors_of(b);
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    if (const int by_base = compare_atoms(left[i].node, right[i].node)) return by_base;
    if (const int by_power = order(right[i].exponent, left[i].exponent)) return by_power;
  }
  return left.size() > right.size() ? -1 : 1;
}

int Dag::compare_atoms(NodeId a, NodeId b) const {
  if (a == b) return 0;
  const Node& left = (*this)[a];
  const Node& right = (*this)[b];
  if (left.kind != right.kind) return left.kind < right.kind ? -1 : 1;
  if (left.kind == NodeKind::symbol) return left.symbol < right.symbol ? -1 : 1;
  if (left.kind == NodeKind::number) return cln::compare(left.number, right.number);
  if (left.kind == NodeKind::product) return compare(a, b);  // a radicand
  if (left.function != right.function) return left.function < right.function ? -1 : 1;
  for (std::size_t i = 0; i < std::min(left.terms.size(), right.terms.size()); ++i) {
    if (const int by_node = compare(left.terms[i].node, right.terms[i].node)) return by_node;
    if (const int by_factor = order(right.terms[i].coefficient, left.terms[i].coefficient)) {
      return by_factor;
    }
  }
  return left.terms.size() > right.terms.size() ? -1 : 1;
}

}  // namespace casimir::codegen
