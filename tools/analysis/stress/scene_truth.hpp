#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/work_precision.hpp"
#include "symbolic/model.hpp"

namespace casimir {

/// What is known about the end of a scene: what its answers are judged by.
struct SceneReference {
  std::vector<std::string> states;           ///< those that are integrated
  std::optional<ReferenceState> truth = {};  ///< of them
  std::string source = {};                   ///< where the truth is from, or why there is none
  bool has_end = true;                       ///< the exact motion reaches the end time
  std::optional<double> singular_time = {};  ///< of a pole of the equations that it meets
  double growth = 0;                         ///< of small changes; infinite: not known
};

/// The case file's reference state, or else that of a multiprecision run of our own with 30 digits.
/// A scene that the file calls a blow-up and gives no reference state has no end, whatever a run of
/// our own says.
/// \param longest  seconds that a run of our own may take.
SceneReference reference_state_of_scene(const Model& model, const Scene& scene, double longest);

}  // namespace casimir
