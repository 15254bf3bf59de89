#pragma once

#include <string>

#include "tools/cli/cli.hpp"
#include "tools/cli/options/kept_parameters.hpp"
#include "tools/cli/options/run_options.hpp"
#include "tools/runs/scene_values.hpp"

namespace casimir::tools {

/// What `integrate --digits N` was asked.
struct DigitsRequest {
  const Common& common;
  const RunOptions& run;
  const KeptParameters& kept;
  const OtherStart& start;
  std::string case_name, in, as, method, output;
  double every = 0;
  int digits = 0;
  SceneOptions how;
};

/// Digits that double precision shows, and that a run can have in reasonable time and memory.
inline constexpr int kLeastDigits = 17, kMostDigits = 5000;

/// Integrates with that many decimal digits and reports those that are sure.
/// \return exit status.
int integrate_with_digits(const DigitsRequest& request);

}  // namespace casimir::tools
