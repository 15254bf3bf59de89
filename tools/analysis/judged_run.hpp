#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/scene_run.hpp"
#include "tools/analysis/trust.hpp"
#include "tools/run_options.hpp"

namespace casimir::tools {

/// A run with everything that is known of how far it can be believed.
struct JudgedRun {
  const Method* method = nullptr;
  std::string chosen;  ///< why, where `auto` chose the method
  Settings settings;
  std::optional<CompiledModule> compiled;  ///< set
  Trajectory trajectory;
  Trust trust;
  std::vector<std::string> projected;  ///< onto the levels of these invariants
  std::vector<std::string> warnings;
  std::string advice;        ///< where the run stopped early
  bool interrupted = false;  ///< by the user
};

struct JudgedOptions {
  std::string method = "auto";
  RunOptions run;
  double time_limit = 0;    ///< in seconds; 0: none
  double sample_every = 0;  ///< time between samples; 0: none
  bool shows_progress = false;
  bool keeps_interrupted = false;  ///< an interrupt ends the run, not the program
};

/// Integrates a scene. `auto` begins with Taylor series, at what double precision can hold where
/// no tolerance is given, and changes to Radau IIA of order 9 where the run shows that the
/// equations are stiff. A proved invariant that drifts beyond what the tolerance allows makes the
/// status `drift_exceeded`. \param run  must outlive the result \throws UsageError  for a method or
/// settings that cannot be
JudgedRun integrate_judged(const Model& model, const SceneRun& run, const JudgedOptions& options);

}  // namespace casimir::tools
