#pragma once

#include <string>
#include <vector>

#include "symbolic/structure/conformal_equations.hpp"

namespace casimir::structure {

/// A cofactor of which some coefficients are roots of irreducible polynomials over Q(parameters).
struct AlgebraicCofactor {
  struct Root {
    std::vector<unsigned long> monomial;
    std::vector<Polynomial> coefficients;  ///< of the powers of the coefficient of the monomial
  };
  Cofactor rational;  ///< the other terms
  std::vector<Root> roots;
};

/// Cofactors of a search, and whether there are no others.
struct Cofactors {
  std::vector<Cofactor> found;
  bool complete = true;
  std::string reason;  ///< where not
  /// There may be others with coefficients that are algebraic over Q(parameters), beside ..
  bool irrational = false;
  std::vector<AlgebraicCofactor> algebraic;  ///< .. these, which were not excluded

  void add(const Cofactor& cofactor);
  void leave_open(const std::string& why);
  /// What is not known of some others is not known of all.
  void add_doubts(const Cofactors& others);
};

/// All f in Q(parameters)[x] for which there is a T up to a degree that is not zero.
///
/// The parts T_top and f_top of the highest degrees obey the equations with the part X_top of the
/// motion, and where X has no constant part, those of the lowest degrees with X_low, as products of
/// parts that are not zero are not zero; there f has no part of less than the degree of X_low
/// less 1. That gives finitely many candidates for these parts of f. In each step the coefficients
/// of f at vertices of Newton's polytope are among finitely many, those outside of it are zero (see
/// `NewtonFaces`), and what is left are unknowns (see `solve_pencil`).
Cofactors conformal_factors(const ConformalEquations& equations, int degree,
                            const search::Watch& watch);
/// The constant ones.
Cofactors constant_factors(const ConformalEquations& equations, int degree,
                           const search::Watch& watch);

}  // namespace casimir::structure
