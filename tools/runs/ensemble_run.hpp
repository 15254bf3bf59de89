#pragma once

#include <string>

#include "tools/cli/cli.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/runs/scene_values.hpp"

namespace casimir::tools {

/// What `integrate --ensemble` was asked.
struct EnsembleRequest {
  const Common& common;
  const RunOptions& run;
  const KeptParameters& kept;
  const OtherStart& start;
  std::string case_name, method, file, output;
  SceneOptions how;
  int jobs = 0;
};

/// Integrates every member of the file and reports.
/// \return the exit status.
int integrate_ensemble(const EnsembleRequest& request);

}  // namespace casimir::tools
