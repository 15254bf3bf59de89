#pragma once

#include <optional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/discrete/modular_program.hpp"

namespace casimir::discrete {

/// A rational map modulo the prime 2^61 - 1, with random values of the parameters.
class ModularMap {
 public:
  using State = std::vector<Element>;

  /// \throws ModelError  for a map that is not rational, and where parameters are assumed to obey
  ///                     an equation, so that they are not generic
  explicit ModularMap(const MapModel& map);
  /// Kahan's map of a quadratic flow, with a random step: no determinant is multiplied out.
  /// \throws ModelError  as above, and for a flow that is not quadratic
  static ModularMap kahan(const Model& flow);

  std::size_t dimension() const { return dimension_; }
  /// The next state; empty where a denominator vanishes.
  std::optional<State> operator()(const State& state) const;
  State random_state() const;

 private:
  ModularMap(const Model& model, const std::vector<GiNaC::ex>& functions);
  std::optional<State> kahan_step(const State& state, const std::vector<Element>& values) const;

  std::size_t dimension_;
  ModularProgram program_;
  std::vector<Element> parameters_;
  std::optional<Element> step_;  ///< of Kahan's map
  mutable std::mt19937_64 random_{20190101};
};

}  // namespace casimir::discrete
