#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace casimir {

/// How far a function may go, between two neighbouring places, from its values there: it is taken
/// to change there by no more than it does from place to place around them and by what a change of
/// its slope adds.
/// \param places  in their order; at least two.
/// \param values  of the function, one for each place.
/// \param i       between this place and the next one.
double reach(std::span<const double> places, std::span<const double> values, std::size_t i);

/// A least value, and the place at which it lies.
struct Dip {
  double place, value;
};

/// The least of the parabola through three places, from this one on, if it lies between them and
/// comes closer to zero than the middle one.
/// \param places  in their order.
/// \param values  of the function, one for each place.
/// \param i       the first of the three.
std::optional<Dip> dip_at(std::span<const double> places, std::span<const double> values,
                          std::size_t i);

}  // namespace casimir
