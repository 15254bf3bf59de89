#pragma once

#include "tools/analysis/section/problem.hpp"
#include "tools/analysis/sweep/grid_point.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// The Poincare section at each point of a grid, on the level that the point's initial state lies
/// on. Columns: how many orbits and crossings, how many of the orbits are regular and chaotic, the
/// largest exponent among them, and how far the crossings are from their level. Where nothing moves
/// across the plane there are no orbits.
class Sections : public SweepTask {
 public:
  /// Model, scene and places outlive it.
  /// \throws RequestError  as section_problem does
  Sections(const Model& model, const Scene& scene, const GridPoints& places, SectionRequest request,
           std::size_t orbits, std::size_t points, double tolerance);

  std::vector<std::string> columns() const override;
  std::string principal_column() const override { return "chaotic"; }
  std::string fingerprint() const override;
  const GridPoints& places() const override { return places_; }
  std::vector<PointResult> run(const std::vector<std::size_t>& points, int threads,
                               const std::function<bool()>& give_up) const override;

 private:
  PointResult cut(std::size_t point, int threads, const std::function<bool()>& give_up) const;

  const Model& model_;
  const Scene& scene_;
  const GridPoints& places_;
  SectionRequest request_;
  std::size_t orbits_, points_;
  double tolerance_;
  std::string text_;  ///< what the section is of
};

}  // namespace casimir
