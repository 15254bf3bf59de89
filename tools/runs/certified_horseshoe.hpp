#pragma once

#include "symbolic/model.hpp"
#include "tools/analysis/certificate/horseshoe_certificate.hpp"
#include "tools/analysis/horseshoe/horseshoe.hpp"

namespace casimir::tools {

/// What others need to verify the theorem that `find_horseshoe` proved for the scene and the
/// request: the equations with the integrals of the level alone, and the surface such that it is
/// crossed upwards. That it holds is for `check_horseshoe` to say.
HorseshoeCertificate certified_horseshoe(const Horseshoe& proof, const Model& model, Scene scene,
                                         const SectionRequest& request);

}  // namespace casimir::tools
