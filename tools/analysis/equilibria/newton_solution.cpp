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
/// them for flat, as long as that is no rounding: a residual that is small in units of the
/// equations may be all that they have there.
void refine(const ScaledEquations& equations, Place& place) {
  constexpr int kRounds = 60;
  constexpr double kLongestRefinement = 100, kNothingLeft = 1e-30;
  double last = equations.error(place);
  for (int round = 0; round < kRounds && last > kNothingLeft; ++round) {
    const Vector step =
        shortest_solution(equations.derivative(place), equations.residual(place), kNoChange);
    if (!(step.norm() <= kLongestRefinement)) return;
    const Place next = equations.moved(place, -step);
    const double error = equations.error(next);
    if (!(error < last / 2)) return;
    place = next;
    last = error;
  }
}

}  // namespace

bool solve(const ScaledEquations& equations, Place& place) {
  if (!approach(equations, place)) return false;
  refine(equations, place);
  return true;
}

}  // namespace casimir::equilibria
