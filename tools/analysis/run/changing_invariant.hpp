#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// An integral or Casimir function of the file whose rate along the motion is not zero at one of
/// some states, to rounding: near the first, and at the others. One that comes back to its value at
/// the end of each step, as sin(Pi*t)^2 may, shows no drift.
/// \param states  of all variables; the first is that of the start
/// \param times   of these states
/// \return  its name; empty where there is none
std::optional<std::string> changing_invariant(const Model& model, const Scene& scene,
                                              const std::vector<std::vector<double>>& states,
                                              const std::vector<double>& times);

/// An integral of the file of a map which certainly has another value at the image of the start, or
/// of a point near it, than there: in balls, at exact numbers. The drift of an orbit does not show
/// what is small beside the invariant's value.
/// \return  its name; empty where none is certain
std::optional<std::string> changing_invariant(const MapModel& map, const Scene& scene);

}  // namespace casimir
