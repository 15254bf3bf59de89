#pragma once

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/proof/claims/claim.hpp"

namespace casimir::discrete {

/// That a map keeps the measure |density| dx, or, on constraints c, |density| dx/dc; of a
/// composition as of one map. It borrows the map.
Claim measure_claim_of_one_map(const MapModel& map, const NamedExpression& density);

}  // namespace casimir::discrete
