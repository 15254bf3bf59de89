#include "tools/analysis/equilibria/newton_solution.hpp"

#include <cmath>

#include "runtime/step/dense.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Newton's iteration with the shortest step that the linear equations allow, as long as it makes
/// the residual smaller: at a multiple root it comes nearer by a part each time.
bool approach(const ScaledEquations& equations, Place& place) {
  constexpr int kRounds = 200, kFree = 30;
  constexpr double kLongestCorrection = 2, kShrinks = 0.7;
  double last = equations.error(place);
  for (int round = 0; round < kRounds; ++round) {
    if (!std::isfinite(last)) return false;
    const Vector step =
        shortest_solution(equations.derivative(place), equations.residual(place), 1e-10);
    const double length = step.norm();
    if (!std::isfinite(length)) return false;
    const Place next = equations.moved(place, length > kLongestCorrection
                                                  ? Vector(-step * (kLongestCorrection / length))
                                                  : Vector(-step));
    const double error = equations.error(next);
    const bool shrinks = error < kShrinks * last;
    if (!shrinks && last < kSolved) return true;
    if (!shrinks && round > kFree) return false;
    place = next;
    last = error;
    if (last == 0) return true;
  }
  return last < kSolved;
}

/// Goes on in the directions in which the equations change so little that the iteration above took
/// them for flat, as long as it comes nearer: a residual that is small in units of the equations
/// may be all that they have there.
/// \param each  each equation in a unit of its own, so that one which hardly changes here is seen
///              beside the others
void refine(const ScaledEquations& equations, Place& place, bool each) {
  constexpr int kRounds = 600;
  constexpr double kLongestRefinement = 100;
  double last = equations.error(place);
  for (int round = 0; round < kRounds && last > 0; ++round) {
    Matrix derivative = equations.derivative(place);
    Vector residual = equations.residual(place);
    for (Eigen::Index i = 0; each && i < residual.size(); ++i) {
      const double unit = derivative.row(i).norm();
      if (!(unit > 0)) continue;
      derivative.row(i) /= unit;
      residual(i) /= unit;
    }
    const Vector step = shortest_solution(derivative, residual, kNoChange);
    if (!(step.norm() <= kLongestRefinement)) return;
    const Place next = equations.moved(place, -step);
    const double error = equations.error(next);
    if (!(error < last / 2)) return;
    place = next;
    last = error;
  }
}

/// Whether no more is left than rounding explains: of the terms, and of the place, which is off by
/// a part of each number, and by a part of the unit where that is 0.
bool is_solved(const ScaledEquations& equations, const Place& place) {
  constexpr double kOfNumber = 1e-12, kTwice = 2;
  constexpr int kPlaces = 4;
  const Vector left = equations.residual(place);
  Vector off(place.x.size() + place.v.size());
  off << place.x.cwiseAbs() / equations.length(), place.v.cwiseAbs();
  Vector by_place = Vector::Zero(left.size());
  for (int k = 0; k < kPlaces; ++k) {
    Vector step(off.size());
    for (Eigen::Index i = 0; i < step.size(); ++i)
      step(i) = (i + k) % 2 == 0 || k / 2 == i % 2 ? kRoundingOfPlace : -kRoundingOfPlace;
    const Vector there = equations.residual(equations.moved(place, step));
    if (there.allFinite()) by_place = by_place.cwiseMax((there - left).cwiseAbs());
  }
  const Vector explained = kSolved * equations.sizes_of_terms(place) + kTwice * by_place +
                           kOfNumber * (equations.derivative(place).cwiseAbs() * off);
  // Beside a term that is infinite anything would be rounding.
  return explained.allFinite() && (left.cwiseAbs().array() <= explained.array()).all();
}

}  // namespace

bool solve(const ScaledEquations& equations, Place& place) {
  if (!approach(equations, place)) return false;
  for (const bool each : {false, true}) refine(equations, place, each);
  return is_solved(equations, place) && !equations.vanish_by_underflow(place);
}

}  // namespace casimir::equilibria
