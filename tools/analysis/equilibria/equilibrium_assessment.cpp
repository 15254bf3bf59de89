#include "tools/analysis/equilibria/equilibrium_assessment.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"
#include "tools/analysis/proof/proved_facts.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Directions that belong to eigenvalues which are exactly zero: those to other members of a
/// family, else those in which the derivative is nothing but rounding. Two roots that are near each
/// other have small eigenvalues, one of them perhaps a positive one.
const Matrix& surely_flat(const Directions& directions, const Equilibrium& found) {
  return found.family > 0 ? directions.flat : directions.zero;
}

}  // namespace

Assessment::Assessment(const Model& model, const Scene& scene, const Specialisation& spec,
                       const std::vector<GiNaC::ex>& integrals, const Equations& equations,
                       const ScaledEquations& scaled, std::mt19937_64& random)
    : equations_(equations),
      scaled_(scaled),
      random_(random),
      bracket_(model, scene),
      forms_(model, scene, integrals),
      kinks_(spec.rhs) {
  if (verdict_on_jacobi(model, scene) != Verdict::proved) return;
  constexpr int kTries = 16;
  for (int k = 0; k < kTries && !generic_; ++k)
    generic_ = bracket_.at(scaled.random_place(random).x);
}

void Assessment::operator()(const Place& place, Equilibrium& found) const {
  const Directions directions = directions_at(scaled_, place);
  Place own = place;
  if (found.velocities.empty()) own.v.setZero();
  const std::vector<Place> nearby = indistinguishable(own, directions, found);
  if (has_no_derivative(own, nearby)) {
    found.eigenvalues.clear();
    found.stability = SpectralStability::no_derivative;
    return;
  }
  const std::optional<Matrix> tangent = equations_.tangent(own.x, own.v);
  const Matrix matrix = linearised(own, tangent);
  LinearStructure known = structure(own, directions, found, tangent);
  if (!tangent) known.forms = [&] { return forms_.at(own.x, matrix); };
  const auto stability = linear_stability(matrix, error_of(own, matrix, nearby, tangent), known);
  if (!stability) return;
  found.eigenvalues = stability->eigenvalues;
  found.stability = stability->stability;
}

std::vector<Place> Assessment::indistinguishable(const Place& place, const Directions& directions,
                                                 const Equilibrium& found) const {
  constexpr int kPoints = 8;
  constexpr double kOfMultipleRoot = 1e-5, kFarthestAside = 1e-2;
  std::vector<Place> result;
  for (int k = 0; k < kPoints; ++k) {
    Vector step(directions.regular.rows());
    for (double& entry : step) entry = sign() * kRoundingOfPlace;
    for (const auto& direction : directions.regular.colwise()) step += sign() * direction;
    if (found.family == 0 || scaled_.error(place) > kManyRoundings * kRoundingOfTerms)
      for (const auto& direction : directions.flat.colwise())
        step += sign() * kOfMultipleRoot * direction;
    if (step.norm() > kFarthestAside) step *= kFarthestAside / step.norm();
    result.push_back(scaled_.moved(place, step));
    if (found.velocities.empty()) result.back().v.setZero();
  }
  return result;
}

Matrix Assessment::error_of(const Place& place, const Matrix& matrix,
                            const std::vector<Place>& nearby,
                            const std::optional<Matrix>& tangent) const {
  constexpr double kOfEntry = 0x1p-49, kOfChange = 2;
  Matrix changes = Matrix::Zero(matrix.rows(), matrix.cols()), sizes = matrix.cwiseAbs();
  if (tangent)  // what cancels along it leaves the rounding of what was there
    sizes = between(tangent->cwiseAbs(), equations_.linearised(place.x, place.v).cwiseAbs(),
                    tangent->cwiseAbs());
  for (const Place& other : nearby) {
    const Matrix there = linearised(other, tangent);
    if (there.allFinite()) changes = changes.cwiseMax((there - matrix).cwiseAbs());
  }
  return kOfEntry * sizes + kOfChange * changes;
}

Matrix Assessment::linearised(const Place& place, const std::optional<Matrix>& tangent) const {
  const Matrix whole = equations_.linearised(place.x, place.v);
  return tangent ? between(*tangent, whole, *tangent) : whole;
}

bool Assessment::has_no_derivative(const Place& place, const std::vector<Place>& nearby) const {
  std::vector<std::vector<double>> inputs;
  for (const Place& other : nearby) inputs.push_back(equations_.inputs(other.x, other.v));
  if (!kinks_.are_at(equations_.inputs(place.x, place.v), inputs)) return false;
  constexpr double kNear = 1e-6, kNearer = 1e-9, kStays = 0.1, kSmall = 1e-7;
  const Differences far = differences(place, kNear), near = differences(place, kNearer);
  const double size = equations_.linearised(place.x, place.v).norm();
  return (near.linearised > kStays * far.linearised && near.linearised > kSmall * size) ||
         (near.rates > kStays * far.rates && near.rates > kSmall * scaled_.rate());
}

Assessment::Differences Assessment::differences(const Place& place, double distance) const {
  constexpr int kWays = 8;
  Differences result;
  const auto take = [](double& largest, double change) {
    if (std::isfinite(change)) largest = std::max(largest, change);
  };
  const auto compare = [&](const Place& one, const Place& other) {
    take(result.rates,
         (equations_.rates(one.x, one.v) - equations_.rates(other.x, other.v)).norm());
    take(result.linearised,
         (equations_.linearised(one.x, one.v) - equations_.linearised(other.x, other.v)).norm());
  };
  std::normal_distribution<double> normal;
  std::optional<Place> first;
  for (int k = 0; k < kWays; ++k) {
    Vector step = Vector::Zero(place.x.size() + place.v.size());
    for (double& entry : step.head(place.x.size())) entry = normal(random_);
    step *= distance / step.norm();
    const Place one = scaled_.moved(place, step);
    if (!first) first = one;
    compare(one, scaled_.moved(place, -step));
    compare(one, *first);  // the derivatives of odd functions are even
  }
  return result;
}

LinearStructure Assessment::structure(const Place& place, const Directions& directions,
                                      const Equilibrium& found,
                                      const std::optional<Matrix>& tangent) const {
  const auto bracket = bracket_.at(place.x);
  if (bracket && generic_ && !tangent)
    if (const auto result =
            hamiltonian_structure(*bracket, *generic_, null_directions(place, directions, found)))
      return *result;
  if (!found.velocities.empty()) return {};
  // Along the level, whose gradients the linearised equations take to 0 from the left, those of
  // the family are taken to 0.
  const auto n = static_cast<Eigen::Index>(equations_.states());
  const Matrix derivative = scaled_.derivative(place);
  Matrix gradients = derivative.bottomLeftCorner(derivative.rows() - n, n);
  Matrix flat = surely_flat(directions, found).topRows(n);
  if (tangent) {
    gradients *= *tangent;
    flat = times(tangent->transpose(), flat);
  }
  LinearStructure result;
  result.zeros = rank_of_directions(gradients.transpose()) + rank_of_directions(flat);
  return result;
}

Matrix Assessment::null_directions(const Place& place, const Directions& directions,
                                   const Equilibrium& found) const {
  const auto n = static_cast<Eigen::Index>(equations_.states());
  const Eigen::Index count = place.v.size();
  const Matrix flows = equations_.by_velocities(place.x, count);
  Matrix columns(n, 0);
  const auto take = [&](const Matrix& more, double least) {
    for (const Vector column : more.colwise()) {
      if (!(column.norm() > least)) continue;
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.rightCols(1) = column.normalized();
    }
  };
  constexpr double kSmallFlow = 1e-8, kSmallPart = 1e-6;
  const bool all_are_null = count <= 1 || found.velocities.empty();
  take(all_are_null ? flows : Matrix(flows * place.v), kSmallFlow * scaled_.length());
  if (all_are_null) take(surely_flat(directions, found).topRows(n), kSmallPart);
  return columns;
}

}  // namespace casimir::equilibria
