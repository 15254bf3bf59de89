#pragma once

#include <functional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// Proves or refutes every claim of the case of a map x -> x' and the facts about it, or, where
/// `candidates` has any, those instead; as `prove` does for flows. Every statement is about all
/// points of the phase space inside the assumptions at which the map and the functions of the claim
/// have real values; where denominators vanish, nothing is said.
///
///   integral            F(x') = F(x)
///   casimir             {x_i, C} = 0
///   invariant_relation  f(x) = 0 implies f(x') = 0
///   conditional         the level is invariant in this sense, and F(x') = F(x) on it
///   measure             rho(x') det(dx'/dx) = rho(x) or -rho(x)
///   map                 {x'_i, x'_j} = +-{x_i, x_j} at x'; symmetries and reversals
///   conjugacy           phi(x') = G(phi(x)), or G(phi(x')) = phi(x), and phi is invertible
///
/// \throws CaseError   for a candidate that cannot be read
/// \throws ModelError  for a case that has no meaning, as a division by zero
std::vector<Proof> prove_map(const MapModel& map, const Candidates& candidates = {},
                             const std::function<bool(const Proof&)>& report = {});

/// What `prove_map` would decide, in its order, all still undecided.
std::vector<Proof> pending(const MapModel& map, const Candidates& candidates = {});

}  // namespace casimir
