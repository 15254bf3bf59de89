#pragma once

#include <optional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::discrete {

/// How far the degrees of iterates are followed.
struct DegreeRequest {
  std::optional<int> iterates;  ///< without it until the degree is large
  bool kahan = false;           ///< of Kahan's map of a flow
};

/// The degrees of the iterates of a rational map on a general line of the affine space, as rational
/// functions of the place on the line: those of x^(1), x^(2), .. They are computed modulo 2^61 - 1,
/// for random parameters and a random line, by interpolation and Euclid's algorithm: each is the
/// true one with a probability of about 1 - 10^-15.
/// \throws ModelError  for a map that is not rational
/// {
std::vector<int> degrees_of_iterates(const MapModel& map, const DegreeRequest& request = {},
                                     const search::Watch& watch = {});
std::vector<int> degrees_of_kahan_iterates(const Model& flow, const DegreeRequest& request = {},
                                           const search::Watch& watch = {});
/// }

}  // namespace casimir::discrete
