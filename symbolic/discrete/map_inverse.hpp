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
/// is inverted step by step; where an inverse of a step need not have a value wherever the step
/// leads, the identity is proved of the whole besides.
/// \param largest  nothing is tried for a map, or a step, of more terms than this
/// \throws TooLarge
std::optional<std::vector<GiNaC::ex>> proved_inverse(const MapModel& map, double largest = 1e6);

/// Whether the map is shown to be one to one where it has values: by an inverse that has values, up
/// to zeros of denominators, wherever the map leads. That (exp(1/log(x)), ..) takes (x^2, ..) back
/// for x > 0 says nothing of -x, which leads to the same point. A composition is if every step is.
/// \param largest  as of `proved_inverse`
bool is_one_to_one(const MapModel& map, double largest);

}  // namespace casimir::discrete
