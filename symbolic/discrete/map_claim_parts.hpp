#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/proof/claims/claim.hpp"

namespace casimir::discrete {

/// That a function vanishes.
Residual difference(Prover& prover, std::string label, const GiNaC::ex& value);

/// That the common zero level of the functions is carried into itself.
std::vector<Residual> level_images(Prover& prover, const MapModel& map,
                                   const std::vector<NamedExpression>& level);

void append(std::vector<GiNaC::ex>& list, const std::vector<GiNaC::ex>& more);

/// The map, and the functions with what they are defined by, at x and at x'.
std::vector<GiNaC::ex> domain_of(const MapModel& map,
                                 const std::vector<NamedExpression>& functions);

/// The claim, where it can be written down: a function may have a pole wherever the map leads.
Claim or_without_value(ClaimKind kind, const std::string& name,
                       const std::function<Claim()>& claim);

/// Adds conditions to those of a verdict, each once.
void add_conditions(Proof& proof, const std::vector<std::string>& conditions);

}  // namespace casimir::discrete
