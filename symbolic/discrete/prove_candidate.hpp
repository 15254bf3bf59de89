#pragma once

#include <optional>
#include <string>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/prove.hpp"

namespace casimir::discrete {

/// Whether the map keeps f.
Proof prove_integral(const MapModel& map, const NamedExpression& f);

/// Whether the map keeps `density * dx`, or changes its sign only.
Proof prove_density(const MapModel& map, const NamedExpression& density);

/// Why what holds at almost all points need not say anything of the domain of the map; empty where
/// it does.
std::optional<std::string> thin_domain_of(const MapModel& map);

/// What such a proof says beside its verdict: the evidence, and where it holds.
std::string evidence_and_conditions(const Proof& proof);

}  // namespace casimir::discrete
