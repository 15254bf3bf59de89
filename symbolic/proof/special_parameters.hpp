#pragma once

#include <string>
#include <vector>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Conditions on parameters without which a matrix has a smaller rank at every point that is tried:
/// "a - 1 != 0" for a factor that all minors have in common, "a^2 + b^2 != 0" for equations that
/// make all of them vanish.
///
/// Where the rank is smaller at all points, so are all minors of that size zero, and those at some
/// numbers for the coordinates as well: common factors of these, and the zeros that they have in
/// common, are all candidates. Each is confirmed at points, unless its equation cannot be solved;
/// then it is a condition all the same. Sets of equations are found where they are linear, and
/// where the minors are long or parameters stand in functions, the value 0 alone is looked at
/// besides.
///
/// Numbers for functions obey no relations, so that of a sin(z)^2 + cos(z)^2 - 1 they show no
/// factor: the rows are reduced by those that the ring knows first, and where a minor, too, is not
/// shown to last for all parameters beside those of the conditions, "a is generic" is one.
/// \param rank  at almost all points for almost all values of the parameters
std::vector<std::string> needed_parameters(Prover& prover, const PolynomialRows& rows,
                                           std::size_t rank);

}  // namespace casimir
