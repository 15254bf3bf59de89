#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "symbolic/algebra/ideal.hpp"
#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// unknown = numerator / denominator, where the denominator is not zero.
struct SolvedUnknown {
  std::size_t place;
  Polynomial numerator, denominator;
};

/// A family of solutions of polynomial equations.
struct Branch {
  std::vector<SolvedUnknown>
      solved;                       ///< in the order of elimination: numerators use later unknowns
  std::vector<Polynomial> rest;     ///< irreducible equations that remain between the others
  std::vector<Polynomial> nonzero;  ///< irreducible: denominators, and what other branches have
  bool decided = true;              ///< false where the equations became too large

  /// p with the solved unknowns put in, times powers of their denominators.
  Polynomial reduced(Polynomial p) const;
};

/// Equations one by one, each for an unknown that those after it do not have and with a leading
/// coefficient without unknowns; empty where they are not of that kind.
std::optional<std::vector<SolvedRelation>> triangular(std::vector<Polynomial> equations,
                                                      const std::vector<std::size_t>& unknowns);

/// Whether all solutions of `part` belong to `family`; false where that is not found out.
bool contains(const Branch& family, const Branch& part, const std::vector<std::size_t>& unknowns);

/// A polynomial by the relations that its parameters obey, as sqrt(2)^2 = 2: zero exactly where the
/// relations make it zero, and else the same times a parameter that is not zero. The relations have
/// to generate a prime ideal, so that no product is zero unless a factor is. Empty: there are none.
using NormalForm = std::function<Polynomial(const Polynomial&)>;

/// Splits equations into branches: unknowns in which an equation is linear with a coefficient that
/// has no unknowns are eliminated, products are split into cases, and where neither is possible a
/// Groebner basis is tried; if that is not triangular, the cases that a coefficient with unknowns
/// is zero or not are split. Variables that are no unknowns are parameters with generic values:
/// what has parameters only is taken not to vanish.
/// \param unknowns  places in the ring
/// With relations between these, what is irreducible over the rational numbers may have factors,
/// and what is then divided by may vanish at some solutions of `rest`: the caller has to look.
/// \param last  those of the unknowns that are eliminated where no other can be
std::vector<Branch> solve_system(std::vector<Polynomial> equations,
                                 const std::vector<std::size_t>& unknowns, const Watch& watch,
                                 const std::vector<std::size_t>& last = {},
                                 const NormalForm& normal_form = {});

/// p where variable `place` is numerator/denominator, times the denominator's power.
Polynomial substituted(const Polynomial& p, std::size_t place, const Polynomial& numerator,
                       const Polynomial& denominator);

/// Puts the value of an unknown into the fraction top/bottom, in both parts: the denominator of an
/// unknown solved before may use this one as well.
void put(const SolvedUnknown& solved, Polynomial& top, Polynomial& bottom);

/// The determinant up to its sign, by Bareiss's elimination without fractions.
Polynomial determinant_without_sign(std::vector<std::vector<Polynomial>> matrix,
                                    const PolynomialRing& ring);

/// The resultant with respect to a variable.
Polynomial resultant(const Polynomial& a, const Polynomial& b, std::size_t place);

}  // namespace casimir::search
