#pragma once

#include <vector>

#include "symbolic/search/conditions/parametric_block.hpp"
#include "symbolic/search/polynomial_system.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::search {

/// Parameters with values that are polynomials in the others.
struct SpecialSet {
  std::vector<std::pair<std::size_t, Polynomial>> values;
  std::size_t conditions() const { return values.size(); }
};

/// Sets on which the equations have more solutions than on all found ones around them, sought among
/// simple ones of up to three conditions: parameters that are zero, equal, opposite, 1, 2 or 1/2,
/// the factors of coefficients, and what makes further common factors where one of these holds, as
/// far as a bound on the work allows. There may be others.
/// \param surfaces  irreducible polynomials on whose zeros there are more solutions
std::vector<SpecialSet> special_sets(const System& system,
                                     const std::vector<ParametricBlock>& blocks,
                                     const std::vector<std::size_t>& free,
                                     const std::vector<Polynomial>& surfaces, const Watch& watch);

}  // namespace casimir::search
