#pragma once

#include "tools/analysis/run/ensemble_check.hpp"
#include "tools/analysis/run/ensemble_kernel.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// Integrates the scene from each point of a grid, in the lanes of registers where `integrate
/// --ensemble` does. Columns: t, the states at the end, the drift of each invariant, the steps.
class Integrations : public SweepTask {
 public:
  /// All of these outlive it.
  /// \param asked  where it names no absolute tolerance, each point has one of its own: see
  ///               `scale_tolerances`
  Integrations(const PreparedScene& run, const GridPoints& places, const Method& method,
               const Settings& settings, std::size_t points, RunRequest asked = {});

  std::vector<std::string> columns() const override;
  std::string fingerprint() const override;
  const GridPoints& places() const override { return places_; }
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

  /// Integrates some of the points that reached the end again by themselves, with an estimate of
  /// their errors: see `check_members`.
  /// \param rows  what `run` gave for all points of the grid, in their order
  std::vector<CheckedMember> check(const std::vector<PointResult>& rows) const;

  /// The largest drift of each invariant, at the points that reached the end.
  std::vector<double> largest_drifts(const std::vector<PointResult>& rows) const;

  /// How many points one register holds.
  int lanes() const { return kernel_.lanes ? kernel_.lanes->lanes : 1; }
  /// Whether points may pass over what lies between the ends of a step: see `may_pass_over`.
  bool passes_over() const { return may_pass_over(run_, settings_); }
  /// Whether all steps have one size.
  bool constant_step() const { return settings_.fixed_step > 0; }

  /// What the user should know of how the code was made, or empty.
  const std::string& warning() const { return kernel_.warning; }

 private:
  Ensemble members(const std::vector<std::size_t>& points) const;

  const PreparedScene& run_;
  const GridPoints& places_;
  const Method& method_;
  const Settings& settings_;
  RunRequest asked_;
  EnsembleKernel kernel_;
};

}  // namespace casimir
