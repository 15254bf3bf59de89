#pragma once

#include "symbolic/structure/separate/leaves.hpp"

namespace casimir::structure {

/// A change of the signs of some coordinates, bit i of `mask` that of x_i, under which the bracket,
/// the level and each of the integrals keep their form up to a sign.
struct Reflection {
  std::size_t mask = 0;
  bool odd = false;  ///< the bivector of the case changes its sign

  /// Whether a bivector with this monomial as its component {x_i, x_j} behaves as that of the case.
  bool keeps(const std::vector<unsigned long>& exponents, std::size_t i, std::size_t j) const;
};

/// All of them, which are a group. Where bivectors are looked for the space of those that behave as
/// that of the case does is much smaller; that a solution is among them is a hope, not a theorem.
std::vector<Reflection> reflections_of(const Leaves& leaves,
                                       const std::vector<Polynomial>& integrals);

}  // namespace casimir::structure
