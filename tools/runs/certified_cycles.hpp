#pragma once

#include <vector>

#include "tools/analysis/certificate/cycle_certificate.hpp"
#include "tools/analysis/section/problem.hpp"
#include "tools/analysis/section/validated_cycles.hpp"

namespace casimir::tools {

/// What others need to verify that the cycles exist: of those that are proved, where the
/// certificate could be made.
std::vector<CycleCertificate> certified_cycles(const Model& model, const Scene& scene,
                                               const SectionProblem& problem,
                                               const std::vector<ProvedCycle>& proofs);

}  // namespace casimir::tools
