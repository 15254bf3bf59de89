#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "codegen/specialise.hpp"
#include "symbolic/discrete/map_model.hpp"

namespace casimir {

/// The step of a map, in which every sign(a) becomes a/|a|, without a value at a = 0. A motion
/// passes such a place between its steps, and has one side or the other; an orbit of a map may
/// stand on it.
Program without_signs_of_zero(const Program& step);

/// The step of a map in the place of a right-hand side, and what goes with it: invariants, the
/// derivative of the step as `jacobian`, its action on a deviation as `variational`.
/// \param inverse  the state before, a function for each variable
/// \throws ModelError  as of `specialise`; for an inverse where states are left out; for Taylor
///                     coefficients, which a map has none of.
Specialisation specialise_map(const MapModel& map, const Scene& scene,
                              const SpecialiseOptions& options = {},
                              const std::optional<std::vector<GiNaC::ex>>& inverse = {});

}  // namespace casimir
