#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/obstruct.hpp"
#include "symbolic/prove.hpp"

namespace casimir::tools {

/// Where the count of Liouville's theorem lacks an integral of a Hamiltonian system, whether one is
/// excluded for the parameters of a scene; a proof that takes longer is given up, and its `reason`
/// says so.
/// \param proofs  what is known of the model; nothing is asked where it is integrable, or claims it
/// \return  empty where nothing was asked
std::optional<obstruction::Obstruction> further_integral(const Model& model,
                                                         const std::string& scene,
                                                         const std::vector<Proof>& proofs,
                                                         double seconds);

/// The answer in one sentence.
std::string further_integral_text(const obstruction::Obstruction& answer);

}  // namespace casimir::tools
