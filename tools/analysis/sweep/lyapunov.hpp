#pragma once

#include "tools/analysis/estimate/saltation.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// The largest Lyapunov exponent of the motion from each point of a grid: the growth of a deviation
/// by the variational equations, made small again along the way, per unit of time. Columns: t, the
/// exponent up to the end, the same up to half of the time, which tells how settled it is, the
/// steps.
class LyapunovExponents : public SweepTask {
 public:
  /// \param run  whose states and parameters the places are; all of these outlive it
  /// \throws RequestError  for equations that depend on the time
  LyapunovExponents(const Model& model, const Scene& scene, const PreparedScene& run,
                    const GridPoints& places, const Method& method, const Settings& settings);

  std::vector<std::string> columns() const override;
  std::string principal_column() const override { return "exponent"; }
  std::string fingerprint() const override;
  std::string reason(Status status) const override;
  const GridPoints& places() const override { return places_; }
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

 private:
  PointResult follow(const Module& module, Saltation& saltation, std::size_t point,
                     const std::function<bool()>& give_up) const;

  const GridPoints& places_;
  const Method& method_;
  const Settings& settings_;
  const Program& rates_;     ///< of the system
  PreparedScene deviating_;  ///< the system and one deviation
};

}  // namespace casimir
