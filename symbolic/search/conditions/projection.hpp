#pragma once

#include <vector>

#include "symbolic/search/polynomial_system.hpp"

namespace casimir::search {

/// Where a family of solutions lies in the space of some of its unknowns, the parameters.
struct Projection {
  enum class Kind {
    dense,      ///< all components of the family are over almost all values of the parameters
    values,     ///< .. over almost all points of the set where some have these values
    relations,  ///< .. where polynomials vanish: those that are left, besides values
    open,       ///< not found out
  };
  Kind kind = Kind::open;
  /// parameter = top / bottom, over the other parameters
  struct Value {
    std::size_t place;
    Polynomial top, bottom;
  };
  std::vector<Value> values;
  std::vector<Polynomial> relations;
};

/// The projection of a branch that `solve_system` found for both kinds of unknowns.
Projection projected(const Branch& branch, const std::vector<std::size_t>& coefficients,
                     const std::vector<std::size_t>& parameters);

}  // namespace casimir::search
