#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"

namespace casimir::discrete {

/// The inverse of a map as functions of the state, psi(phi(x)) = x proved by the prover, one
/// function for each variable; empty where none of the ways to it leads there, which does not say
/// that there is none.
///
/// Candidates, in this order: variables found one after the other from next values that are
/// quotients linear in them, as in Henon's and Lyness' maps; S phi S for the reversing symmetries S
/// of the case, the identity, the exchange of two variables, the change of one sign. A composition
/// is inverted step by step.
/// \param largest  nothing is tried for a map, or a step, of more terms than this
/// \throws TooLarge
std::optional<std::vector<GiNaC::ex>> proved_inverse(const MapModel& map, double largest = 1e6);

}  // namespace casimir::discrete
