#pragma once

#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::discrete {

/// A function that was found; all of them are proved.
struct FoundOfMap {
  GiNaC::ex value;
  std::string text;
  std::string evidence{};  ///< what its proof says beside, and what it depends on
};

/// What a search among polynomials of a degree found of a rational map x -> x'.
///
/// Everything is linear: P(x') = P(x) in the coefficients of P; P(x') = det(dx'/dx) P(x) for a
/// density 1/P; A - h B vanishes along an orbit of A/B = h. Modulo a prime, at random points and
/// parameters, such a system has no larger rank than it has in general: so the dimensions are upper
/// bounds, and where one of them is 0 that is a proof. In general: the assumptions have to leave an
/// open set of points and parameters, as a^2 <= 0 does not.
struct MapSearch {
  std::vector<FoundOfMap> integrals;  ///< independent ones, polynomials before fractions
  std::vector<FoundOfMap> densities;
  std::size_t polynomials = 0;  ///< at most so many independent polynomials, without constants
  std::size_t relations = 0;    ///< independent polynomials that vanish on one orbit, at most
  std::size_t density_space = 0;
  bool no_polynomial = false;        ///< proved: no integral among polynomials of this degree
  bool no_fraction = false;          ///< the same for quotients of them
  std::vector<std::string> generic;  ///< parameters that all this is about generic values of
  /// Why the upper bounds may be about values that the assumptions do not leave: then nothing is
  /// proved by them. Empty where there is no such doubt.
  std::string not_generic;
  std::string reason;  ///< why functions that seem to exist are not shown, or `not_generic`
};

/// \throws ModelError  for a map that is not rational
/// \throws search::TooMuchMemory
MapSearch search_map(const MapModel& map, int degree, const search::Watch& watch = {});

}  // namespace casimir::discrete
