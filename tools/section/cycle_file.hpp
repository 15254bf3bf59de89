#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/analysis/section/problem.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace casimir::tools {

/// Writes certificates of those cycles that are proved, for `casimir check`.
/// \return  of how many; where it is none there is no file.
/// \throws SystemError
std::size_t write_cycle_certificates(const std::string& path, const Model& model,
                                     const Scene& scene, const SectionProblem& problem,
                                     const std::vector<ProvedCycle>& proofs);

}  // namespace casimir::tools
