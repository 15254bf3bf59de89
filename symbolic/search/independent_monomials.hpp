#pragma once

#include "symbolic/search/degree_limit.hpp"
#include "symbolic/search/modular/grading.hpp"
#include "symbolic/search/modular/monomials.hpp"
#include "symbolic/search/modular/samples.hpp"

namespace casimir::search {

/// Monomials of which none is a combination of others as a function, and the parts of a grading.
struct IndependentMonomials {
  Monomials monomials;
  /// The columns of each part, ascending, as the parts are by their first one.
  std::vector<std::vector<std::uint32_t>> parts;
  /// Whether those left out are proved to be combinations of those that are left: then these span
  /// the same functions.
  bool complete = true;
};

/// All monomials within limits, which may be none where the list has all of a degree.
struct MonomialList {
  const Monomials& monomials;
  const std::vector<DegreeLimit>& limits;
};

/// Values of so many functions at as many points are a dense matrix.
/// \throws TooMuchWork
void check_memory_of_values(std::size_t functions, const Watch& watch);

/// Leaves out of the list what is a combination of monomials before it, as c^2 beside 1 and s^2, or
/// x*y beside 1 where y is 1/x. Found degree by degree from values modulo a prime (Buchberger and
/// Moeller 1982), found again with coefficients that are polynomials in the parameters, and checked
/// exactly by the system's ring. A multiple of what is left out is a combination of what stands
/// before it as well, since the order of the list is kept by multiplication, if that is in the
/// list: of limits, none may be higher for another monomial of the combination.
/// \param list     in the order of `all_monomials`, over the fields' places
/// \param samples  of the fields' system, with one point of the parameters for all
IndependentMonomials independent_monomials(const System& system, const Fields& fields,
                                           const MonomialList& list, const Modulus& modulus,
                                           const Point& constants, Samples& samples,
                                           const Watch& watch);

}  // namespace casimir::search
