#include "tools/analysis/equilibria/solution_families.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/flat_directions.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

}  // namespace

std::size_t family_at(const ScaledEquations& equations, const Place& place,
                      std::mt19937_64& random) {
  const Matrix directions = directions_at(equations, place).flat;
  const Eigen::Index flat = directions.cols();
  if (flat == 0) return 0;
  constexpr double kAside = 0.5, kLeast = 0.25;
  std::normal_distribution<double> normal;
  Matrix found(directions.rows(), 0);
  for (Eigen::Index k = 0; k < 3 * flat; ++k) {
    Vector aside(directions.rows());
    for (double& entry : aside) entry = normal(random);
    aside = directions * (directions.transpose() * aside);
    aside *= kAside / aside.norm();
    Place other = equations.moved(place, aside);
    if (!solve(equations, other)) continue;
    Vector way(directions.rows());
    way << (other.x - place.x) / equations.length(), other.v - place.v;
    if (way.norm() < kLeast) continue;
    found.conservativeResize(Eigen::NoChange, found.cols() + 1);
    found.col(found.cols() - 1) = way / way.norm();
  }
  // Families are curved: what is second order aside is no dimension of its own.
  return found.cols() == 0 ? 0 : static_cast<std::size_t>(std::min(flat, rank_of(found, kAside)));
}

bool joined_straight(const ScaledEquations& equations, const Place& a, const Place& b) {
  constexpr int kParts = 16;
  for (int k = 1; k < kParts; ++k)
    if (equations.error(ScaledEquations::between(a, b, static_cast<double>(k) / kParts)) >
        10 * kSolved)
      return false;
  return true;
}

bool joined(const ScaledEquations& equations, const Place& a, const Place& b) {
  constexpr int kWays = 60;
  constexpr double kShort = 0.1;
  Place here = a;
  double left = equations.distance(here, b);
  for (int way = 0; way < kWays; ++way) {
    if (left < kNearEachOther) return true;
    Place next = ScaledEquations::between(here, b, std::min(1., kShort / left));
    if (!solve(equations, next)) return false;
    const double still = equations.distance(next, b);
    if (still > left - std::min(0.2 * kShort, left / 4)) return false;
    here = next;
    left = still;
  }
  return false;
}

}  // namespace casimir::equilibria
