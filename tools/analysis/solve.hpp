#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/analysis/run/assessed_run.hpp"

namespace casimir {

/// What is asked of `solve`.
struct SolveOptions {
  std::string method = "auto";         ///< or one of `method_names`
  RunRequest run = {};                 ///< tolerances, duration, projection
  SceneOptions code = {};              ///< what the equations are specialised for
  double time_limit = 0;               ///< in seconds; 0: none
  double sample_every = 0;             ///< time between `trajectory().samples`; 0: none
  bool dense = false;                  ///< keep what the state at any time follows from
  std::function<bool()> give_up = {};  ///< asked after each step; true ends the run as `stopped`
  /// Told after each step what share of the duration is behind; `auto` may begin anew.
  std::function<void(double share)> progress = {};
};

/// A motion with all that is known of how far it can be believed.
class Solution {
 public:
  /// Where a step of the run began, or the run ended.
  struct Step {
    double time;
    std::vector<double> state;
  };

  /// The names of the states, in their order.
  const std::vector<std::string>& names() const { return scene_->specialisation.states; }
  /// How the run ended, with which state, and how the invariants fared.
  const Trajectory& trajectory() const { return run_.trajectory; }
  /// Whether it reached the end, and nothing contradicts it.
  bool ok() const { return run_.trajectory.status == Status::ok; }
  /// The error of the state at the end, and how much small changes grow.
  const ErrorEstimate& trust() const { return run_.trust; }
  /// The method, why it was chosen, the settings, and sentences on what is in doubt.
  const AssessedRun& run() const { return run_; }
  /// The system as it was specialised and compiled.
  const PreparedScene& scene() const { return *scene_; }

  /// The state at a time of the run, to the tolerance of the run: from the last step before it by a
  /// step or two more.
  /// \throws RequestError  for a time that the run did not reach, a solution that is not dense, and
  ///                       the method of another library for equations that depend on the time.
  std::vector<double> operator()(double t) const;

  /// The start and the end of each step, in the order of the run; of a dense solution.
  const std::vector<Step>& steps() const { return steps_; }

 private:
  friend Solution solve(const Model& model, const Scene& scene, const SolveOptions& options);

  std::unique_ptr<const PreparedScene> scene_;  ///< which the run refers to
  AssessedRun run_;
  std::vector<Step> steps_;
};

/// Integrates a scene of a model: specialises and compiles the equations, chooses the method where
/// it is "auto", watches the invariants, and estimates the error.
/// \throws RequestError  for a method or settings that cannot be.
/// \throws ModelError    for data outside the range of double.
/// \throws CaseError     where neither the scene nor the options have a duration.
Solution solve(const Model& model, const Scene& scene, const SolveOptions& options = {});

}  // namespace casimir
