#pragma once

#include <functional>
#include <vector>

#include "tests/adversary/case.hpp"
#include "tests/adversary/evaluate.hpp"

namespace casimir::adversary {

/// Follows the motion from a point by extrapolated midpoint steps (Gragg, Bulirsch and Stoer) in
/// balls of which only the middle is kept: order 16 at steps of 1/8.
/// \param visit  called with the point after each step; false ends the orbit. It also ends where
///               the field has no real value. \throws NotReal, Unknown  if that is at once
void follow(const Case& claim, Point start, double duration,
            const std::function<bool(const Point&)>& visit);

/// Whether the explicit orbit of the case is a solution of its equations that starts on the level
/// and leaves it, or changes the claim's function; over the time `s` in (0, 1).
/// \param more  further conditions that it has to obey, as those that a proof names
bool explicit_orbit_leaves(const Case& claim, const Point& parameters,
                           const std::vector<Assumption>& more = {});

}  // namespace casimir::adversary
