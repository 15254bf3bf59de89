#include "tools/show/scalar_products.hpp"

#include <algorithm>

namespace casimir::tools {

using codegen::Dag;
using codegen::Factor;
using codegen::Node;
using codegen::NodeId;
using codegen::NodeKind;
using codegen::Scaled;

ScalarProducts::ScalarProducts(Dag& dag, std::vector<std::array<int, 3>> vectors,
                               std::map<Pair, int> symbols)
    : dag_(dag), vectors_(std::move(vectors)), symbols_(std::move(symbols)) {}

Scaled ScalarProducts::in(const Scaled& expression) {
  const Node node = dag_[expression.node];  // a copy: the dag grows below
  std::vector<Scaled> parts{{expression.coefficient, Dag::kOne}};
  switch (node.kind) {
    case NodeKind::sum:
      parts.push_back(in_sum(node.terms));
      break;
    case NodeKind::product:
      for (const Factor& f : node.factors) parts.push_back(dag_.power(in({1, f.node}), f.exponent));
      break;
    case NodeKind::function: {
      std::vector<Scaled> arguments;
      for (const Scaled& argument : node.terms) arguments.push_back(in(argument));
      parts.push_back(dag_.call(node.function, std::move(arguments)));
      break;
    }
    default:
      return expression;
  }
  return dag_.product(parts);
}

Scaled ScalarProducts::in_sum(std::vector<Scaled> terms) {
  bool found = true;
  while (found) {
    found = std::ranges::any_of(
        symbols_, [&](const auto& entry) { return replace_one(terms, entry.first, entry.second); });
  }
  for (Scaled& term : terms) term = in(term);
  return dag_.sum(terms);
}

/// Replaces the first triple of terms that is a product of the pair.
bool ScalarProducts::replace_one(std::vector<Scaled>& terms, const Pair& pair, int symbol) {
  for (std::size_t first = 0; first < terms.size(); ++first) {
    Scaled cofactor{};
    const std::vector<std::size_t> others = partners(terms, first, pair, cofactor);
    if (others.empty()) continue;
    terms[first] = dag_.product({cofactor, dag_.symbol(symbol)});
    for (const std::size_t index : {std::max(others[0], others[1]), std::min(others[0], others[1])})
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(index));
    used_.insert({pair.first, pair.second});
    return true;
  }
  return false;
}

/// Where the first term is cofactor * a_1 * b_1: the places of cofactor * a_2 * b_2 and cofactor *
/// a_3 * b_3, or nothing.
std::vector<std::size_t> ScalarProducts::partners(const std::vector<Scaled>& terms,
                                                  std::size_t first, const Pair& pair,
                                                  Scaled& cofactor) {
  const auto component = [&](std::size_t vector, std::size_t i) {
    return dag_.symbol(vectors_[vector][i]);
  };
  const Scaled a = component(pair.first, 0);
  const Scaled b = component(pair.second, 0);
  const int needed = pair.first == pair.second ? 2 : 1;
  if (exponent(terms[first], a.node) < needed || exponent(terms[first], b.node) < needed) return {};
  cofactor = dag_.product({terms[first], dag_.power(a, -1), dag_.power(b, -1)});
  std::vector<std::size_t> places;
  for (std::size_t i = 1; i < 3; ++i) {
    const Scaled wanted =
        dag_.product({cofactor, component(pair.first, i), component(pair.second, i)});
    const auto place = std::ranges::find_if(terms, [&](const Scaled& term) {
      return term.node == wanted.node && term.coefficient == wanted.coefficient;
    });
    if (place == terms.end()) return {};
    places.push_back(static_cast<std::size_t>(place - terms.begin()));
  }
  return places;
}

cln::cl_RA ScalarProducts::exponent(const Scaled& term, NodeId node) const {
  if (term.node == node) return 1;
  const Node& product = dag_[term.node];
  for (const Factor& f : product.factors) {
    if (f.node == node) return f.exponent;
  }
  return 0;
}

}  // namespace casimir::tools
