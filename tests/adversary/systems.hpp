#pragma once

#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/identities.hpp"
#include "tests/adversary/random.hpp"

namespace casimir::adversary {

/// A system with what is known of it.
struct Known {
  System system;
  std::vector<Expr> integrals;   ///< beside the Hamiltonian
  std::vector<Expr> casimirs{};  ///< independent
  Atoms atoms;                   ///< of which disguises may be made
  /// Functions that the flow moves, so that most multiples of them are no integrals.
  std::vector<Expr> moving;
};

/// A random system of one of the kinds of phase space, at random in its coefficients.
Known random_system(Random& random);
/// One with a Poisson bracket.
Known random_poisson_system(Random& random);
/// Two canonical pairs and H = p1^2 c: functions of p1 and p2 commute.
Known free_particle(Random& random);
/// A bracket mu * grad C in three dimensions, which is Poisson whatever mu and C are.
Known gradient_bracket(Random& random);
/// dx/dt = mu * grad A x grad B, with the density 1/mu.
Known nambu(Random& random);

/// A random polynomial in the integrals, and now and then a function of it.
Expr combination(Random& random, const std::vector<Expr>& integrals);

}  // namespace casimir::adversary
