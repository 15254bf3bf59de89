#pragma once

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
  Integrations(const PreparedScene& run, const GridPoints& places, const Method& method,
               const Settings& settings, std::size_t points);

  std::vector<std::string> columns() const override;
  std::string fingerprint() const override;
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

  /// How many points one register holds.
  int lanes() const { return kernel_.lanes ? kernel_.lanes->lanes : 1; }
  /// What the user should know of how the code was made, or empty.
  const std::string& warning() const { return kernel_.warning; }

 private:
  const PreparedScene& run_;
  const GridPoints& places_;
  const Method& method_;
  const Settings& settings_;
  EnsembleKernel kernel_;
};

}  // namespace casimir
