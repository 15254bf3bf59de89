#pragma once

#include <cln/rational.h>

#include <vector>

#include "symbolic/search/system.hpp"

namespace casimir::search {

/// Those of some parameters on which a function depends that the equations use: exp(n*x), or a root
/// with n in its radicand. At special values such functions obey relations that they do not obey
/// for generic ones, which linear algebra over polynomials in the parameter does not see.
std::vector<std::size_t> inside_functions(const System& system,
                                          const std::vector<std::size_t>& free);

/// Values to try for a parameter inside a function: small fractions, and those that the numbers in
/// the equations suggest. They are no more than guesses; each has to be confirmed.
std::vector<cln::cl_RA> simple_values(const Model& model);

/// The number of different real roots of a polynomial in one variable.
long real_roots(const Polynomial& p, std::size_t place);

}  // namespace casimir::search
