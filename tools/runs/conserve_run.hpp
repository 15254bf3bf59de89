#pragma once

#include <functional>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/plot/drift_plot.hpp"
#include "tools/text/runs/run_report.hpp"

namespace casimir::tools {

/// What `conserve` does with a scene and a method.
struct ConserveOptions {
  RunRequest run = {};
  SceneOptions code = {};
  double bound = 1e-9;  ///< largest drift allowed
  /// Told now and then which share of the run is done, from 0 to 1.
  std::function<void(double share)> progress = {};
  std::function<bool()> give_up = {};
};

/// The methods that run where none are named.
const std::vector<std::string>& conserving_methods();

/// Integrates a scene with everything observed and compares every invariant with its first value.
/// Where the scene has a reference state the row has the error, too.
/// \param drifts  if not null, the drift along the run is added to it.
/// \throws UsageError  for settings that cannot be
Row conserve_scene(const Model& model, const Scene& scene, const Method& method,
                   const ConserveOptions& options, std::vector<DriftRecord>* drifts = nullptr);

}  // namespace casimir::tools
