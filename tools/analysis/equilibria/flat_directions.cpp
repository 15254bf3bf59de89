#include "tools/analysis/equilibria/flat_directions.hpp"

#include <algorithm>
#include <vector>

#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A direction in which the derivative has the size `size`, and what may be off of the equations in
/// it: by rounding of the terms that they have at the place.
struct Singular {
  Vector direction;
  double size = 0, rounding = 0;
};

/// By how much the derivative in a direction is another one so far aside.
double change_of_derivative(const ScaledEquations& equations, const Place& place,
                            const Matrix& derivative, const Singular& of, double way) {
  double change = 0;
  for (const double sign : {-1., 1.}) {
    const Place other = equations.moved(place, sign * way * of.direction);
    const double here = ((equations.derivative(other) - derivative) * of.direction).norm();
    change = here <= change ? change : here;  // what is no number is the larger one
  }
  return change;
}

/// Whether the derivative is nothing but rounding: beside the others, or where it is that of a
/// place which differs by rounding. What is small in the units of the equations alone need not be:
/// they may be large elsewhere.
bool is_zero(const ScaledEquations& equations, const Place& place, const Matrix& derivative,
             const Singular& of, double largest) {
  if (of.size <= kNoChange * largest) return true;
  constexpr double kMany = 10;
  return of.size <= kNoChange &&
         change_of_derivative(equations, place, derivative, of, kRoundingOfPlace) > kMany * of.size;
}

/// Whether the equations change in a direction by so little that rounding may have made it. At a
/// multiple root, or beside a family that is curved, the derivative is another one within what
/// rounding moves the solution; that of equations that are regular and badly conditioned is the
/// same (the quantity of Kantorovich's theorem on Newton's iteration).
/// \param largest  of the sizes of the derivative in all directions
bool is_flat(const ScaledEquations& equations, const Place& place, const Matrix& derivative,
             const Singular& of, double largest) {
  if (of.size <= kNoChange * std::max(1., largest)) return true;
  if (of.size > kFlat * largest) return false;
  constexpr double kFarthestAside = 0.1;
  const double way = std::min(kFarthestAside, kManyRoundings * of.rounding / of.size);
  return !(change_of_derivative(equations, place, derivative, of, way) <= of.size / 2);
}

}  // namespace

Directions directions_at(const ScaledEquations& equations, const Place& place) {
  const Matrix derivative = equations.derivative(place);
  const auto [sizes, all] = singular_directions_of(derivative);
  const Vector off =
      kRoundingOfTerms * equations.sizes_of_terms(place) + equations.residual(place).cwiseAbs();
  std::vector<Eigen::Index> flat, zero, regular;
  std::vector<double> moved;
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    Singular of{all.col(k), sizes(k)};
    // What is off of the equations moves the solution in the direction that they change in by it.
    if (of.size > 0) of.rounding = (derivative * of.direction / of.size).cwiseAbs().dot(off);
    if (is_zero(equations, place, derivative, of, sizes(0))) zero.push_back(k);
    const bool is_regular = !is_flat(equations, place, derivative, of, sizes(0));
    (is_regular ? regular : flat).push_back(k);
    if (is_regular) moved.push_back(of.rounding / of.size);
  }
  Directions result{all(Eigen::all, flat), all(Eigen::all, zero), all(Eigen::all, regular)};
  for (std::size_t k = 0; k < regular.size(); ++k)
    result.regular.col(static_cast<Eigen::Index>(k)) *= moved[k];
  return result;
}

}  // namespace casimir::equilibria
