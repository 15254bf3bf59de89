#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/integrate.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/estimate/error_estimate.hpp"
#include "tools/analysis/run/interpreted_first.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir {

/// What `auto` changes to where the equations are stiff: Radau IIA of order 9.
inline constexpr const char* kStiffMethod = "radau9";

/// A run with everything that is known of how far it can be believed.
struct AssessedRun {
  const Method* method = nullptr;
  std::string chosen;  ///< why, where `auto` chose the method
  Settings settings;
  std::optional<CompiledModule> compiled;  ///< set
  std::shared_ptr<const LaterCode> later;  ///< of code that begins interpreted, else null
  Trajectory trajectory;
  ErrorEstimate trust;
  std::vector<std::string> projected;  ///< onto the levels of these invariants
  /// Sentences on how the run was made and on its invariants, where these leave a doubt.
  std::vector<std::string> doubts;
  /// States that the estimate of the error says nothing of: a sentence.
  std::optional<std::string> unestimated;
  /// Where the equations come near a division by zero: a sentence.
  std::optional<std::string> near_singular;
};

/// What is asked of a run, and what watches it.
struct AssessmentOptions {
  std::string method = "auto";
  RunRequest run = {};
  double time_limit = 0;    ///< in seconds; 0: none
  double sample_every = 0;  ///< time between samples; 0: none
  /// If set, called with the settings of each run, which it may add to, and with what does it.
  std::function<void(Settings& settings, const std::function<void()>& run)> around = {};
};

/// Integrates a scene. `auto` begins with Taylor series, at what double precision can hold where
/// no tolerance is given, and changes to Radau IIA of order 9 where the run shows that the
/// equations are stiff. A proved invariant that drifts beyond what the tolerance allows makes the
/// status `drift_exceeded`.
/// \param run  must outlive the result.
/// \throws RequestError  for a method or settings that cannot be.
AssessedRun integrate_assessed(const Model& model, const Scene& scene, const PreparedScene& run,
                               const AssessmentOptions& options);

}  // namespace casimir
