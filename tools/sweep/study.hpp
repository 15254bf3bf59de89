#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/analysis/run/ensemble_check.hpp"
#include "tools/analysis/run_request.hpp"
#include "tools/analysis/section/problem.hpp"
#include "tools/analysis/sweep/grid.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/integrations.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir::tools {

/// What is done at each point of a sweep, by name.
inline constexpr const char *kIntegrate = "integrate", *kSection = "section",
                            *kExponents = "exponents", *kIndicators = "indicators",
                            *kRotation = "rotation";

/// What is asked of a sweep.
struct StudyRequest {
  std::string task = kIntegrate, method = "auto";
  std::vector<std::string> over, lets;                   ///< see `read_grid` and `read_lets`
  std::optional<std::vector<std::string>> observe = {};  ///< states that must be computed
  RunRequest run = {};
  SectionRequest section = {};
  std::size_t orbits = 16, points = 200;  ///< of a section
};

/// A grid with what is studied at its points.
class SweepStudy {
 public:
  /// \param model, scene  outlive it.
  /// \throws RequestError  for an empty grid, a task that there is none of, or one that these
  ///                       equations or this method do not have.
  SweepStudy(const Model& model, const Scene& scene, const StudyRequest& asked);

  const Grid& grid() const { return grid_; }
  const Method& method() const { return *method_; }
  const Settings& settings() const { return settings_; }
  const SweepTask& task() const { return *task_; }
  /// Points that are integrated at a time in one register.
  int lanes() const;

  /// Integrates some points again by themselves, with an estimate of their errors; none of a task
  /// that is no integration.
  /// \param rows  of all points
  std::vector<CheckedMember> check(const std::vector<PointResult>& rows) const;
  /// What is in doubt of the results: sentences.
  /// \param rows  of all points, or of none
  /// \param checked  of `check`, where it could be made
  std::vector<std::string> warnings(const std::vector<PointResult>& rows,
                                    const std::vector<CheckedMember>& checked) const;

 private:
  std::unique_ptr<SweepTask> task_of(const StudyRequest& asked) const;

  const Model& model_;
  const Scene& scene_;
  Grid grid_;
  const Method* method_;
  PreparedScene run_;
  Settings settings_;
  std::unique_ptr<GridPoints> places_;
  std::unique_ptr<SweepTask> task_;
};

/// Whether orbits are followed until they have their points, and not for a time.
bool follows_crossings(const std::string& task);

}  // namespace casimir::tools
