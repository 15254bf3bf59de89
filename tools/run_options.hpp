#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/methods.hpp"
#include "tools/analysis/scene_run.hpp"
#include "tools/cli_names.hpp"

namespace casimir::tools {

/// The options of a run that `integrate`, `conserve` and `bench` share.
struct RunOptions {
  std::optional<double> rtol, atol, tolerance, step;
  std::optional<std::string> duration;
  unsigned long long max_steps = 0;
  bool project = false;                   ///< onto every invariant that is proved
  std::vector<std::string> project_onto;  ///< only onto these
  bool projects() const { return project || !project_onto.empty(); }
};

void add_run_options(CLI::App& command, RunOptions& options);

/// `--project` and `--project-onto`.
void add_projection(CLI::App& command, RunOptions& options);

/// Settings for a scene. The absolute tolerance of `--tolerance` is in units of the initial state
/// where that is smaller than 1: a tiny scene is not all tolerance. Without any option it is a
/// thousandth of that.
/// \throws UsageError  for a duration that is no number.
Settings settings_for(const RunOptions& options, const SceneRun& run,
                      double default_tolerance = 1e-10);

/// The method of that name; "auto" is resolved. \throws UsageError  with the nearest name.
const Method& method_named(const std::string& name);

/// All names, for help texts.
std::string method_list();

}  // namespace casimir::tools
