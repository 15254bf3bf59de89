#include "tools/analysis/equilibria/equilibrium_collection.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/eigenvalue_discs.hpp"
#include "tools/analysis/equilibria/flat_directions.hpp"
#include "tools/analysis/equilibria/solution_families.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// Of eigenvalues that tell members of families apart, relative to the largest: rounding splits a
// triple zero by the cube root of its size.
constexpr double kZeroEigenvalue = 1e-5;

/// In units in which rows and columns are alike: eigenvalues stay, and its size is one of them.
Matrix balanced(const Matrix& a) {
  const Vector units = balancing_units(a);
  return units.cwiseInverse().asDiagonal() * a * units.asDiagonal();
}

/// Empty where the eigenvalues cannot be computed.
std::optional<Equilibrium> described(const Equations& equations, const ScaledEquations& scaled,
                                     const Place& place) {
  const auto& [x, v] = place;
  Equilibrium result;
  result.state.assign(x.data(), x.data() + x.size());
  const bool moves =
      v.size() > 0 &&
      equations.rates(x, Vector::Zero(v.size())).lpNorm<Eigen::Infinity>() > 1e-8 * scaled.rate();
  if (moves) result.velocities.assign(v.data(), v.data() + v.size());
  Matrix linearised = equations.linearised(x, moves ? v : Vector::Zero(v.size()));
  if (const auto tangent = equations.tangent(x, v))
    linearised = between(*tangent, linearised, *tangent);
  const Matrix matrix = balanced(linearised);
  const auto values = eigenvalues_of(matrix);
  if (!values) return std::nullopt;
  result.degenerate = directions_at(scaled, place).flat.cols() > 0;
  // A flat direction is known to kFlat of the units, and its eigenvalues to the root of that.
  const double unit_rate = scaled.rate() / scaled.length();
  const double zero = result.degenerate ? 2 * std::sqrt(kFlat * unit_rate * linearised.norm())
                                        : kZeroEigenvalue * matrix.norm();
  constexpr double kRounding = 3e-7;  // of a double eigenvalue: the root of that of an entry
  const double small = std::max(zero, kRounding * linearised.norm());
  for (const std::complex<double>& value : *values) {
    result.eigenvalues.emplace_back(std::abs(value.real()) < small ? 0 : value.real(),
                                    std::abs(value.imag()) < small ? 0 : value.imag());
  }
  const double unit = matrix.norm() > 0 ? 1e5 / matrix.norm() : 1;
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end(),
            [unit](const auto& a, const auto& b) {
              return std::pair(-std::round(a.real() * unit), -a.imag()) <
                     std::pair(-std::round(b.real() * unit), -b.imag());
            });
  result.residual = equations.rates(x, v).lpNorm<Eigen::Infinity>();
  return result;
}

/// Whether members of two families have the same eigenvalues: then one stands for both.
bool alike(const Equilibrium& a, const Equilibrium& b) {
  if (a.eigenvalues.size() != b.eigenvalues.size()) return false;  // where constraints are singular
  double largest = 0, distance = 0;
  for (std::size_t i = 0; i < a.eigenvalues.size(); ++i) {
    distance = std::max(distance, std::abs(a.eigenvalues[i] - b.eigenvalues[i]));
    largest = std::max({largest, std::abs(a.eigenvalues[i]), std::abs(b.eigenvalues[i])});
  }
  return distance <= std::sqrt(kNearEachOther) * largest;
}

}  // namespace

void Collection::add(const Place& place, bool also_degenerate) {
  auto found = described(equations_, scaled_, place);
  if (!found || (found->degenerate && !also_degenerate)) return;
  if (found->degenerate) found->family = family_at(scaled_, place, random_);
  std::size_t home = groups_.size();
  for (std::size_t g = 0; g < groups_.size();) {
    if (!belongs(*found, place, groups_[g])) {
      ++g;
    } else if (home == groups_.size()) {
      home = g++;
    } else {  // what seemed two is one
      auto& points = groups_[home].points;
      points.insert(points.end(), groups_[g].points.begin(), groups_[g].points.end());
      groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(g));
    }
  }
  if (home == groups_.size()) groups_.push_back({std::move(*found), {}});
  groups_[home].points.push_back(place);
}

std::vector<Equilibrium> Collection::equilibria(
    const std::function<void(const Place&, Equilibrium&)>& assess) const {
  std::vector<Equilibrium> result;
  for (const Group& group : groups_) {
    result.push_back(group.first);
    assess(group.points.front(), result.back());  // it was the first
  }
  return result;
}

bool Collection::belongs(const Equilibrium& found, const Place& place, const Group& group) const {
  const Equilibrium& first = group.first;
  if (found.velocities.size() != first.velocities.size()) return false;
  const Place& nearest = *std::ranges::min_element(
      group.points, {}, [&](const Place& point) { return scaled_.distance(point, place); });
  if (scaled_.distance(nearest, place) < kNearEachOther) return true;
  if (found.degenerate != first.degenerate) return false;
  if (found.degenerate && joined_straight(scaled_, nearest, place)) return true;
  if (found.family == 0 || found.family != first.family) return false;
  return alike(found, first) || joined(scaled_, place, nearest);
}

}  // namespace casimir::equilibria
