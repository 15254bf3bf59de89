#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "symbolic/discrete/map_model.hpp"

namespace casimir::discrete {

/// Whether what every step of a composition keeps, at the points at which the functions have values
/// before and after the step, is kept by the composition: a function without a value between the
/// steps would tell nothing of the next ones. It is so where
///
/// - the functions have values everywhere, as polynomials, sines and exponentials of these, or
/// - functions and steps are quotients of polynomials, and there is a point from which all of them
///   have values at all steps. Then they have at almost all points, and two quotients that are
///   equal there are equal wherever both have values. The assumptions have to leave an open set.
///
/// \param functions  with the parts that GiNaC has simplified away
bool have_values_between_steps(const MapModel& map, const std::vector<GiNaC::ex>& functions);

}  // namespace casimir::discrete
