#pragma once

#include <array>
#include <functional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "tools/analysis/section/orbits.hpp"

namespace casimir {

/// Orbits of a map, with the growth of a deviation and the plotted pair at every point. The step is
/// compiled once, with its derivative.
class MapOrbits {
 public:
  /// \param pair  what is plotted, two functions
  /// \throws RequestError  for a plotted function that is a constant
  /// \throws EnvironmentError  where there is no compiler
  MapOrbits(const MapModel& map, const Scene& scene, const std::vector<FunctionText>& pair,
            std::function<bool()> give_up);

  /// The map with the numbers of the scene.
  const Specialisation& specialisation() const { return run_.specialisation; }
  /// The pair, with labels.
  const std::array<PlottedFunction, 2>& plotted() const { return plotted_; }
  /// The start of the scene.
  std::vector<double> start() const { return run_.initial; }
  /// Whether `give_up` says so.
  bool interrupted() const { return give_up_ && give_up_(); }
  /// The step and a deviation, compiled.
  const CompiledModule& step() const { return step_; }

  /// The iterates x_1, .. of a state; fewer than `points` where the next one is not finite, which
  /// makes the status `non_finite`. The `times` are the numbers of the steps.
  OrbitReport orbit(const std::vector<double>& seed, std::size_t points) const;

  /// So many starts: that of the scene, and others in a box about its orbit, half as large again,
  /// whose own orbits stay within ten times that box. Where fewer are found there are fewer.
  std::vector<std::vector<double>> spread(std::size_t orbits, std::size_t points) const;

 private:
  bool allowed(const std::vector<double>& x) const;

  const MapModel& map_;
  const Scene& scene_;
  const std::function<bool()> give_up_;
  PreparedScene run_;
  std::array<PlottedFunction, 2> plotted_;
  CompiledModule step_;
};

}  // namespace casimir
