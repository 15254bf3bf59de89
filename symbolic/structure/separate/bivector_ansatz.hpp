#pragma once

#include "symbolic/search/watch.hpp"
#include "symbolic/structure/separate/reflections.hpp"

namespace casimir::structure {

/// The bivectors P' up to a degree that may give variables in which integrals separate, as far as
/// the conditions are linear: on the level P' dC = 0 for Casimir functions C, {F_i, F_j}' = 0 and
/// [P, P'] = 0.
struct BivectorSpace {
  /// Linearly independent of each other and of c*P with Casimir functions c.
  std::vector<Bivector> basis;
  bool empty = false;  ///< proved: there is none, for generic parameters
};

/// \param casimirs  that are known; those of the level are added
/// \param integrals  in involution
/// \param degree  highest, of the components as polynomials in the coordinates
/// \param reflections  only bivectors that behave as that of the case under these are looked for;
///     where there are any, `empty` says nothing of others
BivectorSpace compatible_bivectors(const Leaves& leaves, const std::vector<Polynomial>& casimirs,
                                   const std::vector<Polynomial>& integrals, int degree,
                                   const std::vector<Reflection>& reflections,
                                   const search::Watch& watch);

/// Of the members of the space those that are Poisson on the level, [P', P'] = 0, the shortest
/// first: some of each family of solutions, where these are simple. Of a large space only sums of
/// vectors of the basis of which each two are compatible.
std::vector<Bivector> poisson_members(Leaves& leaves, const std::vector<Bivector>& basis,
                                      const search::Watch& watch);

}  // namespace casimir::structure
