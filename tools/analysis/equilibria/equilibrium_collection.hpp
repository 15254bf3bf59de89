#pragma once

#include <functional>
#include <random>
#include <vector>

#include "tools/analysis/equilibria/equilibria.hpp"
#include "tools/analysis/equilibria/relative_equations.hpp"

namespace casimir::equilibria {

/// What was found: equilibria with all points that belong to each.
class Collection {
 public:
  /// \param equations, scaled, random  have to outlive it
  Collection(const Equations& equations, const ScaledEquations& scaled, std::mt19937_64& random)
      : equations_(equations), scaled_(scaled), random_(random) {}

  /// Takes in a solution, with the one that it belongs to.
  /// \param also_degenerate  if not, one that may be one of many is left out
  void add(const Place& place, bool also_degenerate);

  /// \param assess  completes what is said of each, at the point that stands for it
  std::vector<Equilibrium> equilibria(
      const std::function<void(const Place&, Equilibrium&)>& assess) const;

 private:
  struct Group {
    Equilibrium first;
    std::vector<Place> points;
  };

  bool belongs(const Equilibrium& found, const Place& place, const Group& group) const;

  const Equations& equations_;
  const ScaledEquations& scaled_;
  std::mt19937_64& random_;
  std::vector<Group> groups_;
};

}  // namespace casimir::equilibria
