#pragma once

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/prove.hpp"

namespace casimir::discrete {

/// Whether the map keeps f.
Proof prove_integral(const MapModel& map, const NamedExpression& f);

/// Whether the map keeps `density * dx`, or changes its sign only.
Proof prove_density(const MapModel& map, const NamedExpression& density);

}  // namespace casimir::discrete
