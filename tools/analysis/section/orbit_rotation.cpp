#include "tools/analysis/section/orbit_rotation.hpp"

#include <algorithm>
#include <cmath>

namespace casimir {
namespace {

Rotation rotation_with(const OrbitReport& orbit, const std::vector<bool>& angles,
                       const std::array<double, 2>& periods) {
  OrbitPoints points{
      .dimension = angles.size() + static_cast<std::size_t>(std::ranges::count(angles, true)),
      .coordinates = {},
      .places = orbit.places,
      .periods = periods};
  const std::size_t n = angles.size();
  for (std::size_t k = 0; k < orbit.places.size(); ++k)
    for (std::size_t i = 0; i < n; ++i) {
      const double x = orbit.orbit.states[k * n + i];
      points.coordinates.push_back(angles[i] ? std::cos(x) : x);
      if (angles[i]) points.coordinates.push_back(std::sin(x));
    }
  return rotation_of(points);
}

}  // namespace

Rotation rotation_of_orbit(const SectionProblem& problem, const OrbitReport& orbit) {
  return rotation_with(orbit, problem.angles,
                       {problem.plotted[0].period, problem.plotted[1].period});
}

Rotation rotation_of_map_orbit(const OrbitReport& orbit) {
  return rotation_with(orbit, std::vector<bool>(static_cast<std::size_t>(orbit.seed.size())), {});
}

}  // namespace casimir
