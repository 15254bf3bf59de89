#pragma once

#include "symbolic/structure/separate/roots.hpp"

namespace casimir::structure {

/// Polynomials s_1, .., s_n in one variable: entry (j, m) is the coefficient of its m-th power in
/// s_j. It is made of parameters and Casimir functions, and so constant on each leaf.
using Multipliers = std::vector<std::vector<Polynomial>>;

/// Multipliers with sum_j s_j(u_i) {u_k, F_j} = 0 for i != k on the level: one set for all roots
/// or, where these are polynomials, one for each of them, in their order.
struct StaeckelForm {
  std::vector<Polynomial> roots;  ///< empty where one set is for all of them
  std::vector<Multipliers> multipliers;
};

/// Products of Casimir functions, 1 first: what constants may be made of on a leaf.
std::vector<Polynomial> leaf_constants(const Leaves& leaves,
                                       const std::vector<Polynomial>& casimirs);

/// Of the lowest degree in the root, up to a moderate one; empty where there are none. Each
/// equation is checked after they were found.
std::optional<StaeckelForm> staeckel_form(const Leaves& leaves, const RootCoefficients& a,
                                          const std::vector<Polynomial>& integrals,
                                          const std::vector<Polynomial>& casimirs,
                                          const search::Watch& watch);

}  // namespace casimir::structure
