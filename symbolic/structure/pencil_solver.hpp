#pragma once

#include <string>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/search/watch.hpp"
#include "symbolic/structure/parametric_kernel.hpp"

namespace casimir::structure {

/// A quotient of polynomials in the parameters.
struct PencilValue {
  Polynomial top, bottom;
};

/// Values of the unknowns at which a matrix has a kernel.
struct PencilSolutions {
  std::vector<std::vector<PencilValue>> found;  ///< a value for each unknown
  bool complete = true;                         ///< there are no others in Q(parameters)
  std::string reason;                           ///< where not
  bool irrational = false;  ///< there may be others that are algebraic over Q(parameters) ..
  /// .. and of a single unknown these are roots of these irreducible polynomials.
  std::vector<Polynomial> roots;
};

/// Finitely many values u in Q(parameters), among which are all for which a matrix M(u) has a
/// kernel vector that is not zero.
///
/// Elimination without fractions over the polynomials in u gives the full rank, and then M(u) has
/// no kernel but where a pivot or a factor that was divided out of a row vanishes. Each of their
/// irreducible factors is a case for itself: what is linear in an unknown, with a coefficient that
/// has none, gives its value, which is put in; one of a single unknown and of degree 2 or higher
/// has no zero in Q(parameters), by Gauss's lemma; others are solved together with the equations
/// for a kernel vector, whose last entry that is not zero is 1.
/// \param ring   the variables of the case, then the unknowns
/// \param first  place of the first unknown
PencilSolutions solve_pencil(std::vector<ParametricRow> rows, std::size_t columns,
                             const PolynomialRing& ring, std::size_t first,
                             const search::Watch& watch);

}  // namespace casimir::structure
