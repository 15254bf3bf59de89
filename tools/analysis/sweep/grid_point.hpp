#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/model.hpp"
#include "tools/analysis/run/prepared_scene.hpp"
#include "tools/analysis/sweep/grid.hpp"

namespace casimir {

/// Initial state and parameters at the points of a grid: the scene's, with the values of the axes
/// and of the lets in their place.
class GridPoints {
 public:
  /// \param run  with the parameters of the axes and lets at run time
  /// \param lets  over the axes of the grid
  /// \throws std::invalid_argument  for lets without their text
  /// \throws RequestError  for a point that violates an assumption or leaves a constraint; the
  ///                     message names it
  GridPoints(const Model& model, const Scene& scene, const PreparedScene& run, const Grid& grid,
             const Lets& lets);

  /// How many there are.
  std::size_t count() const { return grid_.points(); }

  /// State and parameters of the run at a point.
  std::pair<std::vector<double>, std::vector<double>> at(std::size_t point) const;

  /// The scene with the values of a point, as the exact numbers that these doubles are.
  Scene scene_at(std::size_t point, const Model& model, const Scene& scene) const;

  /// Every value of the axes, and the lets: what a sweep follows from beside its task.
  const std::string& fingerprint() const { return fingerprint_; }

 private:
  struct Target {
    bool state;
    std::size_t place;  ///< among the states or the parameters of the run; or beyond: left out
    std::string name;
  };
  Target target(const std::string& name) const;
  void check(const Model& model, const Scene& scene) const;

  const PreparedScene& run_;
  const Grid& grid_;
  std::vector<Target> axes_, lets_;
  Program let_values_;  ///< inputs: the axes, then the parameters of the run
  std::string fingerprint_;
};

}  // namespace casimir
