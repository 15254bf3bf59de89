#include "symbolic/discrete/modular_map.hpp"

#include <fmt/format.h>

#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/thin_domain.hpp"

namespace casimir::discrete {
namespace {

/// A field and its Jacobian matrix, row by row. That the second derivatives are numbers is checked
/// where they are polynomials of the variables, which a program of rational functions with random
/// parameters cannot tell.
std::vector<GiNaC::ex> field_and_slopes(const Model& flow) {
  std::vector<GiNaC::ex> result = flow.field;
  for (const GiNaC::ex& rate : flow.field) {
    for (const GiNaC::symbol& x : flow.variables) result.push_back(rate.diff(x));
  }
  return result;
}

}  // namespace

ModularMap::ModularMap(const Model& model, const std::vector<GiNaC::ex>& functions)
    : dimension_(model.variables.size()), program_(model.symbols(), functions) {
  for (const Assumption& assumption : model.assumptions) {
    if (assumption.comparison == Comparison::equal)
      throw ModelError(fmt::format(
          "'{}' is assumed, and degrees are those for generic values: a definition can say it",
          assumption.text));
  }
  if (!model.assumptions.empty()) {
    Prover prover(model, {}, Subject::functions);
    if (const auto thin = thin_domain(prover))
      throw ModelError(fmt::format(
          "degrees are those for generic values: {}; a definition can say what is assumed", *thin));
  }
  const PrimeField field;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    parameters_.push_back(field.random(random_));
}

ModularMap::ModularMap(const MapModel& map) : ModularMap(map.base, map.next) {}

ModularMap ModularMap::kahan(const Model& flow) {
  ModularMap map(flow, field_and_slopes(flow));
  map.step_ = PrimeField().random(map.random_);
  return map;
}

ModularMap::State ModularMap::random_state() const {
  const PrimeField field;
  State state;
  for (std::size_t i = 0; i < dimension_; ++i) state.push_back(field.random(random_));
  return state;
}

std::optional<ModularMap::State> ModularMap::operator()(const State& state) const {
  std::vector<Element> arguments = state;
  arguments.insert(arguments.end(), parameters_.begin(), parameters_.end());
  const auto values = program_.run(arguments);
  if (!values || !step_) return values;
  return kahan_step(state, *values);
}

/// x + eps k, where (I - (eps/2) f') k = f, by Gauss's elimination.
std::optional<ModularMap::State> ModularMap::kahan_step(const State& state,
                                                        const std::vector<Element>& values) const {
  const PrimeField field;
  const std::size_t n = dimension_;
  const Element half = field.multiply(*step_, field.inverse(2));
  std::vector<std::vector<Element>> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      rows[i].push_back(
          field.subtract(i == j ? 1 : 0, field.multiply(half, values[n + i * n + j])));
    rows[i].push_back(values[i]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && rows[pivot][k] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(rows[pivot], rows[k]);
    const Element scale = field.inverse(rows[k][k]);
    for (std::size_t j = k; j <= n; ++j) rows[k][j] = field.multiply(scale, rows[k][j]);
    for (std::size_t i = 0; i < n; ++i) {
      const Element factor = rows[i][k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = k; j <= n; ++j)
        rows[i][j] = field.subtract(rows[i][j], field.multiply(factor, rows[k][j]));
    }
  }
  State next;
  for (std::size_t i = 0; i < n; ++i)
    next.push_back(field.add(state[i], field.multiply(*step_, rows[i][n])));
  return next;
}

}  // namespace casimir::discrete
