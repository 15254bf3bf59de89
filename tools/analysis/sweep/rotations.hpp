#pragma once

#include "tools/analysis/section/problem.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// The rotation number of the orbit from each point of a grid, cut with the plane of the section.
/// Columns: the kind (1 curve, 2 islands, 3 cycle, 0 none of these), the rotation number and its
/// error, the number of islands or the length of the cycle, of islands the rotation number along
/// one of them and its error, the crossings that were found, MEGNO. What is not known is no number.
class Rotations : public SweepTask {
 public:
  /// Model, scene and places outlive it.
  /// \throws RequestError  as section_problem does
  Rotations(const Model& model, const Scene& scene, const GridPoints& places,
            SectionRequest request, std::size_t points, double tolerance);

  std::vector<std::string> columns() const override;
  std::string principal_column() const override { return "rotation"; }
  std::string fingerprint() const override;
  const GridPoints& places() const override { return places_; }
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

 private:
  PointResult turn(std::size_t point, const std::function<bool()>& give_up) const;

  const Model& model_;
  const Scene& scene_;
  const GridPoints& places_;
  SectionRequest request_;
  std::size_t points_;
  double tolerance_;
  std::string text_;  ///< what the section is of
};

}  // namespace casimir
