#pragma once

#include <string>

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Why nothing is said of densities where the motion may change the volume across the constraints.
inline constexpr const char* kNoMeasureOnConstraints =
    "the motion is not shown to keep the volume across the constraints: a density of all variables "
    "need be none on them";

/// A density is a real function that is not zero on any piece of the domain: leaves `proof`, of
/// what its equation says, undecided where this is not shown.
void judge_density(Prover& prover, Proof& proof, const GiNaC::ex& density);

/// What is said of a density that was seen to be positive at some points and negative at others;
/// empty where it was not.
std::string note_on_signs(Prover& prover, const GiNaC::ex& density);

}  // namespace casimir
