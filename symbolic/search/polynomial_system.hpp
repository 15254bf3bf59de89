#pragma once

#include <vector>

#include "symbolic/polynomial.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// unknown = numerator / denominator; the denominator has no unknowns.
struct SolvedUnknown {
  std::size_t place;
  Polynomial numerator, denominator;
};

/// A family of solutions of polynomial equations.
struct Branch {
  std::vector<SolvedUnknown>
      solved;                    ///< in the order of elimination: numerators use later unknowns
  std::vector<Polynomial> rest;  ///< irreducible equations that remain between the others
  bool decided = true;           ///< false where the equations became too large

  /// p with the solved unknowns put in, times powers of their denominators.
  Polynomial reduced(Polynomial p) const;
};

/// Splits equations into branches: unknowns in which an equation is linear with a coefficient that
/// has no unknowns are eliminated, products are split into cases, and where neither is possible a
/// Groebner basis is tried. Variables that are no unknowns are parameters with generic values:
/// what has parameters only is taken not to vanish.
/// \param unknowns  places in the ring
std::vector<Branch> solve_system(std::vector<Polynomial> equations,
                                 const std::vector<std::size_t>& unknowns, const Watch& watch);

/// p where variable `place` is numerator/denominator, times the denominator's power.
Polynomial substituted(const Polynomial& p, std::size_t place, const Polynomial& numerator,
                       const Polynomial& denominator);

/// The determinant up to its sign, by Bareiss's elimination without fractions.
Polynomial determinant_without_sign(std::vector<std::vector<Polynomial>> matrix,
                                    const PolynomialRing& ring);

/// The resultant with respect to a variable.
Polynomial resultant(const Polynomial& a, const Polynomial& b, std::size_t place);

}  // namespace casimir::search
