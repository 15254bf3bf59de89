#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/ensemble.hpp"
#include "runtime/integrate.hpp"
#include "runtime/methods.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What a run shall be like, as far as anything is asked: the rest follows from the scene.
struct RunRequest {
  std::optional<double> rtol, atol;
  std::optional<double> tolerance;   ///< both; the absolute one in units of a small initial state
  std::optional<double> step;        ///< constant, instead of error control
  std::optional<double> duration;    ///< without it that of the scene
  unsigned long long max_steps = 0;  ///< 0: no limit
  bool project = false;              ///< onto every invariant that is proved
  std::vector<std::string> project_onto;  ///< only onto these
  /// Whether anything is projected onto.
  bool projects() const { return project || !project_onto.empty(); }
};

/// Settings for a scene. The absolute tolerance of `tolerance` is in units of the initial state
/// where that is smaller than 1: a tiny scene is not all tolerance. Without any request it is a
/// thousandth of that.
/// \throws CaseError  where neither the request nor the scene has a duration.
Settings settings_for(const RunRequest& request, const PreparedScene& run,
                      double default_tolerance = 1e-10);

/// Gives each member of an ensemble an absolute tolerance in units of its own initial state, where
/// `settings_for` takes that of the scene: a member that is a thousand millionth of the scene would
/// be all tolerance, and one of a tiny scene that is not has no digits to ask for below its own.
/// They are in powers of 16, so that few members have one of their own; within 16 of the scene's
/// they are the scene's. Nothing is done where the request names an absolute tolerance.
/// \param settings  as `settings_for` made them
void scale_tolerances(const RunRequest& request, const PreparedScene& run, const Settings& settings,
                      Ensemble& ensemble);

/// The method of that name; "auto" is resolved.
/// \throws RequestError  with the nearest name.
const Method& method_named(const std::string& name);

}  // namespace casimir
