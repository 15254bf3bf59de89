#pragma once

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Why nothing is said of densities where the constraints are not constant along the motion.
inline constexpr const char* kNoMeasureOnConstraints =
    "the constraints are not constant along the motion beside their zero level: a density of all "
    "variables is none on that";

/// A density is a real function that is not zero on any piece of the domain: leaves `proof`, of
/// what its equation says, undecided where this is not shown.
void judge_density(Prover& prover, Proof& proof, const GiNaC::ex& density);

}  // namespace casimir
