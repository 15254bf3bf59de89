#pragma once

#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/proof/claims/claim.hpp"

namespace casimir::discrete {

/// The claims of a case about its map. They borrow the map.
/// {
Claim integral_claim(const MapModel& map, const NamedExpression& f,
                     const std::vector<NamedExpression>& on);
Claim invariant_relation_claim(const MapModel& map, const NamedExpression& f,
                               const std::vector<NamedExpression>& on);
Claim measure_claim(const MapModel& map, const NamedExpression& density);
Claim casimir_claim(const MapModel& map, const NamedExpression& f,
                    const std::vector<NamedExpression>& on);
Claim poisson_claim(const MapModel& map);
Claim symmetry_claim(const MapModel& map, const MapSymmetry& symmetry);
Claim conjugacy_claim(const MapModel& map, const MapConjugacy& conjugacy);
/// }

/// Those that the case file has, for their rows in `claim_kinds.cpp`.
/// {
std::vector<Claim> poisson_claims(const MapModel& map);
std::vector<Claim> integral_claims(const MapModel& map);
std::vector<Claim> conditional_claims(const MapModel& map);
std::vector<Claim> invariant_relation_claims(const MapModel& map);
std::vector<Claim> measure_claims(const MapModel& map);
std::vector<Claim> symmetry_claims(const MapModel& map);
std::vector<Claim> conjugacy_claims(const MapModel& map);
/// }

/// Enough integrals in involution, of a Poisson map that is shown to keep them: then it is a shift
/// on the tori of their common levels (Veselov 1991).
std::vector<Claim> liouville_claims(const MapModel& map);

}  // namespace casimir::discrete
