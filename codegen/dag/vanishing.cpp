#include "codegen/dag/vanishing.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "codegen/optimise/terms.hpp"

namespace casimir::codegen {

namespace {

constexpr std::size_t kMostTermsOfExpansion = 2000;

std::optional<TermSystem> expansion(const Dag& dag, const Scaled& e, std::size_t inputs) {
  return expanded(system_of(dag, inputs, {e}), kMostTermsOfExpansion);
}

const Polynomial& result_of(const TermSystem& system) {
  return system.variables[static_cast<std::size_t>(system.outputs[0])].value;
}

/// The part of a monomial in the states, and the rest; nothing if it has other things than inputs.
std::optional<std::pair<Monomial, Monomial>> split(const Monomial& monomial, std::size_t states,
                                                   std::size_t inputs) {
  Monomial product;
  Monomial coefficient;
  for (const VariablePower& l : monomial) {
    if (static_cast<std::size_t>(l.variable) >= inputs) return std::nullopt;
    (static_cast<std::size_t>(l.variable) < states ? product : coefficient).push_back(l);
  }
  return std::pair{product, coefficient};
}

}  // namespace

bool vanishes(const Dag& dag, const Scaled& expression, std::size_t inputs) {
  if (expression.coefficient == 0) return true;
  if (dag[expression.node].kind != NodeKind::sum) return false;
  const auto system = expansion(dag, expression, inputs);
  return system && result_of(*system).empty();
}

std::vector<VanishingTerm> vanishing_terms(Dag& dag, const Scaled& general, const Scaled& folded,
                                           std::size_t states, std::size_t inputs) {
  const auto before = expansion(dag, general, inputs);
  const auto after = expansion(dag, folded, inputs);
  if (!before || !after) return {};
  std::set<Monomial> remaining;
  for (const Term& term : result_of(*after)) {
    const auto parts = split(term.monomial, states, inputs);
    if (!parts) return {};
    remaining.insert(parts->first);
  }
  const auto power_product = [&](const Monomial& monomial, const cln::cl_RA& factor) {
    std::vector<Scaled> factors{{factor, Dag::kOne}};
    for (const VariablePower& l : monomial) {
      factors.push_back(dag.power(dag.symbol(l.variable), l.exponent));
    }
    return dag.product(factors);
  };
  std::vector<Monomial> order;
  std::map<Monomial, std::vector<Scaled>> coefficients;
  for (const Term& term : result_of(*before)) {
    const auto parts = split(term.monomial, states, inputs);
    if (!parts) return {};
    if (remaining.contains(parts->first)) continue;
    if (!coefficients.contains(parts->first)) order.push_back(parts->first);
    coefficients[parts->first].push_back(power_product(parts->second, term.coefficient));
  }
  std::vector<VanishingTerm> result;
  for (const Monomial& product : order) {
    result.push_back(
        {dag.text(power_product(product, 1)), dag.text(dag.sum(coefficients[product]))});
  }
  return result;
}

}  // namespace casimir::codegen
