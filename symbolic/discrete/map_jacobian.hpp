#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/proof/prover.hpp"

namespace casimir::discrete {

/// dx'_i/dx_j in the prover's ring.
std::vector<std::vector<Polynomial>> jacobian(Prover& prover, const MapModel& map);

/// Without divisions, row by row over the sets of columns.
Polynomial determinant(const PolynomialRing& ring,
                       const std::vector<std::vector<Polynomial>>& matrix);

/// det(dx'/dx) by GiNaC alone, not expanded.
GiNaC::ex jacobian_determinant(const MapModel& map);

}  // namespace casimir::discrete
