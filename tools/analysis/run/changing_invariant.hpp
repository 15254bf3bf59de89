#pragma once

#include <optional>
#include <string>
#include <vector>

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

}  // namespace casimir
