#pragma once

#include <string>

#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/options/run_options.hpp"

namespace casimir::tools {

/// What `integrate --frequencies` was asked.
struct FrequencyRequest {
  const Common& common;
  const RunOptions& run;
  const Model& model;
  const Scene& scene;
  const PreparedScene& prepared;
  std::string method;
  std::size_t lines = 0;  ///< of each variable
};

/// Integrates a scene, more densely until its spectrum ends before the highest frequency that the
/// samples can tell, and reports the frequencies of its variables.
/// \return the exit status
int integrate_frequencies(const FrequencyRequest& request);

}  // namespace casimir::tools
