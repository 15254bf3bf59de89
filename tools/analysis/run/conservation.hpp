#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/row.hpp"
#include "tools/analysis/run_request.hpp"

namespace casimir {

/// How a scene is integrated to see what it conserves.
struct ConservationOptions {
  RunRequest run = {};
  SceneOptions code = {};  ///< everything is observed, whatever it says of that
  double bound = 1e-9;     ///< largest drift allowed
  /// Told now and then which share of the run is done, from 0 to 1.
  std::function<void(double share)> progress = {};
  std::function<bool()> give_up = {};
  /// May add to the settings of the run; is told the names of the invariants.
  std::function<void(Settings& settings, const std::vector<std::string>& invariants)> watch = {};
};

/// The drift of every invariant along a run.
struct Conservation {
  Row row;  ///< `row.drift` is the largest; of a scene with a reference state with the error, too
  std::vector<std::string> invariants;
  std::optional<Trajectory> trajectory;  ///< none where the method does not suit the scene
};

/// The methods that run where none are named.
const std::vector<std::string>& conserving_methods();

/// Integrates a scene with everything observed and compares every invariant with its first value.
/// \throws RequestError  for settings that cannot be
Conservation conserve(const Model& model, const Scene& scene, const Method& method,
                      const ConservationOptions& options);

}  // namespace casimir
