#pragma once

#include <functional>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// Where a Groebner basis is given up.
struct GroebnerLimits {
  std::size_t reductions = 2000, elements = 200;
  std::size_t terms = 20000;  ///< of an element
  double bits = 20000;        ///< of a coefficient of an element
};

/// A Groebner basis of the ideal of `generators` in the ring's order, by Buchberger's algorithm
/// with his two criteria. Stops early on ideals that grow too large; what it returns always
/// generates the same ideal, so that remainder zero modulo it always proves membership.
/// \throws TooLarge  beyond the limit `work`, while it is counted
std::vector<Polynomial> groebner_basis(const std::vector<Polynomial>& generators,
                                       const GroebnerLimits& limits = {});

/// A polynomial equation seen as one for its main variable.
struct SolvedRelation {
  Polynomial relation;
  std::size_t variable;
  Polynomial leading;  ///< coefficient of the variable's highest power; free of the coordinates
};

/// Orders the relations so that each has a main variable, one of the first `coordinates`,
/// that no later one contains, with a leading coefficient that is free of the coordinates, also
/// within functions. Empty if that is impossible. Where the leading
/// coefficients are not zero, reduction by such a set decides membership in the ideal.
std::vector<SolvedRelation> triangular_set(
    std::vector<Polynomial> relations, std::size_t coordinates,
    const std::function<bool(const Polynomial&)>& uses_coordinates);

/// The remainder of pseudo-division by all of the set: zero exactly when some product of the
/// leading coefficients times `p` lies in the ideal.
Polynomial pseudo_remainder(const Polynomial& p, const std::vector<SolvedRelation>& set);

}  // namespace casimir
