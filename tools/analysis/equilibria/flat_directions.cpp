#include "tools/analysis/equilibria/flat_directions.hpp"

#include <algorithm>
#include <vector>

#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Whether the equations change in a direction by so little that rounding may have made it. At a
/// multiple root, or beside a family that is curved, the derivative is another one within what
/// rounding moves the solution; that of equations that are regular and badly conditioned is the
/// same (the quantity of Kantorovich's theorem on Newton's iteration).
/// \param size     of the derivative in this direction
/// \param largest  of its sizes in all directions
bool is_flat(const ScaledEquations& equations, const Place& place, const Matrix& derivative,
             const Vector& direction, double size, double largest) {
  if (size <= kNoChange * std::max(1., largest)) return true;
  if (size > kFlat * largest) return false;
  constexpr double kFarthestAside = 0.1;
  const double way = std::min(kFarthestAside, kManyRoundings * kRoundingOfRates / size);
  for (const double sign : {-1., 1.}) {
    const Place other = equations.moved(place, sign * way * direction);
    const double change = ((equations.derivative(other) - derivative) * direction).norm();
    if (!(change <= size / 2)) return true;
  }
  return false;
}

}  // namespace

Directions directions_at(const ScaledEquations& equations, const Place& place) {
  const Matrix derivative = equations.derivative(place);
  const auto [sizes, all] = singular_directions_of(derivative);
  std::vector<Eigen::Index> flat, regular;
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    (is_flat(equations, place, derivative, all.col(k), sizes(k), sizes(0)) ? flat : regular)
        .push_back(k);
  Directions result{all(Eigen::all, flat), all(Eigen::all, regular)};
  const double residual = kRoundingOfRates + equations.error(place);
  for (std::size_t k = 0; k < regular.size(); ++k)
    result.regular.col(static_cast<Eigen::Index>(k)) *= residual / sizes(regular[k]);
  return result;
}

}  // namespace casimir::equilibria
