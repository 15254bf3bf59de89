#pragma once

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// A density is a real function that is not zero on any piece of the domain: leaves `proof`, of
/// what its equation says, undecided where this is not shown.
void judge_density(Prover& prover, Proof& proof, const GiNaC::ex& density);

}  // namespace casimir
