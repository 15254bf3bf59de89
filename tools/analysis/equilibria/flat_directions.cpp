#include "tools/analysis/equilibria/flat_directions.hpp"

#include <algorithm>
#include <utility>
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

/// The derivative at a place, each equation in a unit.
class UnitDerivative {
 public:
  /// \param units  of the equations, in those of `equations`
  UnitDerivative(const ScaledEquations& equations, const Place& place, Vector units)
      : equations_(equations), place_(place), units_(std::move(units)), here_(at(place)) {}

  const Matrix& here() const { return here_; }
  /// What may be off of the equations: rounding of their terms, and what is left of them.
  Vector off() const {
    return (kRoundingOfTerms * equations_.sizes_of_terms(place_) +
            equations_.residual(place_).cwiseAbs())
        .cwiseQuotient(units_);
  }
  /// By how much it is another one in a direction so far aside.
  double change(const Vector& direction, double way) const {
    double change = 0;
    for (const double sign : {-1., 1.}) {
      const Place other = equations_.moved(place_, sign * way * direction);
      const double here = ((at(other) - here_) * direction).norm();
      change = here <= change ? change : here;  // what is no number is the larger one
    }
    return change;
  }

 private:
  Matrix at(const Place& place) const {
    return units_.cwiseInverse().asDiagonal() * equations_.derivative(place);
  }

  const ScaledEquations& equations_;
  const Place& place_;
  Vector units_;
  Matrix here_;
};

/// Whether the derivative is nothing but rounding: beside the others, or where it is that of a
/// place which differs by rounding. What is small in the units of the equations alone need not be:
/// they may be large elsewhere.
bool is_zero(const UnitDerivative& derivative, const Singular& of, double largest) {
  if (of.size <= kNoChange * largest) return true;
  constexpr double kMany = 10;
  return of.size <= kNoChange &&
         derivative.change(of.direction, kRoundingOfPlace) > kMany * of.size;
}

/// Whether the equations change in a direction by so little that rounding may have made it. At a
/// multiple root, or beside a family that is curved, the derivative is another one within what
/// rounding moves the solution; that of equations that are regular and badly conditioned is the
/// same (the quantity of Kantorovich's theorem on Newton's iteration).
/// \param largest  of the sizes of the derivative in all directions
bool is_flat(const UnitDerivative& derivative, const Singular& of, double largest) {
  if (of.size <= kNoChange * std::max(1., largest)) return true;
  if (of.size > kFlat * largest) return false;
  constexpr double kFarthestAside = 0.1;
  const double way = std::min(kFarthestAside, kManyRoundings * of.rounding / of.size);
  return !(derivative.change(of.direction, way) <= of.size / 2);
}

/// What the derivative is in these units.
Directions directions_of(const UnitDerivative& derivative) {
  const auto [sizes, all] = singular_directions_of(derivative.here());
  const Vector off = derivative.off();
  std::vector<Eigen::Index> flat, zero, regular;
  std::vector<double> moved;
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    Singular of{all.col(k), sizes(k)};
    // What is off of the equations moves the solution in the direction that they change in by it.
    if (of.size > 0) of.rounding = (derivative.here() * of.direction / of.size).cwiseAbs().dot(off);
    if (is_zero(derivative, of, sizes(0))) zero.push_back(k);
    const bool is_regular = !is_flat(derivative, of, sizes(0));
    (is_regular ? regular : flat).push_back(k);
    if (is_regular) moved.push_back(of.rounding / of.size);
  }
  Directions result{all(Eigen::all, flat), all(Eigen::all, zero), all(Eigen::all, regular)};
  for (std::size_t k = 0; k < regular.size(); ++k)
    result.regular.col(static_cast<Eigen::Index>(k)) *= moved[k];
  return result;
}

}  // namespace

Directions directions_at(const ScaledEquations& equations, const Place& place) {
  const Eigen::Index count = equations.sizes_of_terms(place).size();
  Directions result = directions_of(UnitDerivative(equations, place, Vector::Ones(count)));
  if (result.flat.cols() == 0) return result;
  // Flat beside what the equations are elsewhere; beside what they are here they may change a lot.
  constexpr double kClear = 1e-3;
  const UnitDerivative local(equations, place, equations.units_around(place));
  const Vector sizes = singular_directions_of(local.here()).sizes;
  if (!(sizes.minCoeff() > kClear)) return result;
  Directions regular = directions_of(local);
  return regular.flat.cols() == 0 ? std::move(regular) : std::move(result);
}

}  // namespace casimir::equilibria
