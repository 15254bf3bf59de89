#pragma once

#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/run/conservation.hpp"
#include "tools/plot/drift_plot.hpp"

namespace casimir::tools {

/// What `conserve` says of a scene, with the drift along the run.
/// \param drifts  if not null, a record for a picture is added to it.
/// \throws RequestError  for settings that cannot be
Row conserve_scene(const Model& model, const Scene& scene, const Method& method,
                   const ConservationOptions& options, std::vector<DriftRecord>* drifts = nullptr);

}  // namespace casimir::tools
