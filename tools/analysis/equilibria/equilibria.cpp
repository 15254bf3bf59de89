#include "tools/analysis/equilibria/equilibria.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "codegen/emit/number_literal.hpp"
#include "codegen/specialise.hpp"
#include "runtime/program/interpreter.hpp"
#include "runtime/step/dense.hpp"
#include "symbolic/search/search.hpp"
#include "tools/analysis/equilibria/eigenvalue_discs.hpp"
#include "tools/analysis/equilibria/kinks.hpp"
#include "tools/analysis/equilibria/linear_stability.hpp"

namespace casimir {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr std::size_t kMostStarts = 400;
// Of eigenvalues that tell members of families apart, relative to the largest: rounding splits a
// triple zero by the cube root of its size.
constexpr double kZeroEigenvalue = 1e-5;

/// The integrals of degree 1 that are no Casimirs.
std::vector<GiNaC::ex> linear_integrals(const Model& model, std::vector<std::string>& names) {
  std::vector<GiNaC::ex> result;
  if (!model.poisson || model.time) return result;
  search::Request request;
  request.degree = 1;
  for (const search::Found& found : search::find_integrals(model, request).found) {
    if (found.verdict != Verdict::proved) continue;
    result.push_back(found.value);
    names.push_back(found.text);
  }
  return result;
}

/// The model with H - sum v_k F_k in place of H; the velocities v_k are parameters, at the end.
Model with_velocities(Model model, Scene& scene, const std::vector<GiNaC::ex>& integrals,
                      std::vector<std::string>& names) {
  for (std::size_t k = 0; k < integrals.size(); ++k) {
    const GiNaC::symbol velocity(fmt::format("velocity_{}", k + 1));
    model.hamiltonian = *model.hamiltonian - velocity * integrals[k];
    model.parameters.push_back(velocity);
    scene.parameters.push_back(0);
    names.push_back(velocity.get_name());
  }
  if (!integrals.empty()) model.field = model.poisson->flow(*model.hamiltonian);
  model.integrals.clear();
  for (std::size_t k = 0; k < integrals.size(); ++k)
    model.integrals.push_back({fmt::format("symmetry_{}", k + 1), integrals[k], {}});
  return model;
}

/// The equations of a relative equilibrium: rates and differences to the level, for the state and
/// the velocities.
class Equations {
 public:
  Equations(const Specialisation& spec, std::size_t velocities)
      : states_(spec.states.size()),
        velocities_(velocities),
        inputs_(spec.rhs.inputs.size(), 0),
        rhs_(spec.rhs),
        jacobian_(spec.jacobian.program),
        invariants_(spec.invariants),
        gradients_(spec.gradients.program),
        jacobian_entries_(spec.jacobian.entries),
        gradient_entries_(spec.gradients.entries),
        all_(spec.invariants.outputs.size()) {
    // H is on no level here.
    for (std::size_t i = 0; i < spec.invariant_names.size(); ++i)
      if (spec.invariant_names[i] != "H") level_.push_back(i);
    std::vector<double> start(spec.start.outputs.size());
    Interpreter run(spec.start);
    run(nullptr, start.data());
    start_ = Eigen::Map<Vector>(start.data(), static_cast<Eigen::Index>(states_));
    values_ = invariants(start_, Vector::Zero(static_cast<Eigen::Index>(velocities_)));
  }

  const Vector& start() const { return start_; }
  std::size_t states() const { return states_; }

  /// Of the right-hand side.
  const std::vector<double>& inputs(const Vector& x, const Vector& v) const {
    std::copy(x.data(), x.data() + x.size(), inputs_.begin());
    std::copy(v.data(), v.data() + v.size(),
              inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
    return inputs_;
  }

  Vector rates(const Vector& x, const Vector& v) const {
    Vector result(static_cast<Eigen::Index>(states_));
    rhs_(filled(x, v), result.data());
    return result;
  }

  Vector residual(const Vector& x, const Vector& v) const {
    Vector result(static_cast<Eigen::Index>(states_ + level_.size()));
    result << rates(x, v), invariants(x, v) - values_;
    return result;
  }

  /// What each velocity adds to the rates: the flows of the symmetries, reversed.
  Matrix by_velocities(const Vector& x, Eigen::Index count) const {
    Matrix result(static_cast<Eigen::Index>(states_), count);
    const Vector base = rates(x, Vector::Zero(count));
    for (Eigen::Index k = 0; k < count; ++k)  // the rates are affine in the velocities
      result.col(k) = rates(x, Vector::Unit(count, k)) - base;
    return result;
  }

  /// Of the rates by the state: the linearised equations.
  Matrix linearised(const Vector& x, const Vector& v) const {
    Matrix result =
        Matrix::Zero(static_cast<Eigen::Index>(states_), static_cast<Eigen::Index>(states_));
    std::vector<double> entries(jacobian_entries_.size());
    jacobian_(filled(x, v), entries.data());
    for (std::size_t k = 0; k < entries.size(); ++k)
      result(jacobian_entries_[k].first, jacobian_entries_[k].second) = entries[k];
    return result;
  }

  Matrix derivative(const Vector& x, const Vector& v) const {
    const auto n = static_cast<Eigen::Index>(states_);
    Matrix result = Matrix::Zero(n + static_cast<Eigen::Index>(level_.size()),
                                 n + static_cast<Eigen::Index>(velocities_));
    result.topLeftCorner(n, n) = linearised(x, v);
    result.topRightCorner(n, v.size()) = by_velocities(x, v.size());
    std::vector<double> entries(gradient_entries_.size());
    gradients_(filled(x, v), entries.data());
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const auto [state, invariant] = gradient_entries_[k];
      const auto place =
          std::find(level_.begin(), level_.end(), static_cast<std::size_t>(invariant));
      if (place != level_.end()) result(n + (place - level_.begin()), state) = entries[k];
    }
    return result;
  }

 private:
  const double* filled(const Vector& x, const Vector& v) const { return inputs(x, v).data(); }
  Vector invariants(const Vector& x, const Vector& v) const {
    std::vector<double> values(all_);
    invariants_(filled(x, v), values.data());
    Vector result(static_cast<Eigen::Index>(level_.size()));
    for (std::size_t i = 0; i < level_.size(); ++i)
      result(static_cast<Eigen::Index>(i)) = values[level_[i]];
    return result;
  }

  std::size_t states_, velocities_;
  mutable std::vector<double> inputs_;
  Interpreter rhs_, jacobian_, invariants_, gradients_;
  std::vector<std::pair<int, int>> jacobian_entries_, gradient_entries_;
  std::size_t all_;
  std::vector<std::size_t> level_;
  Vector start_, values_;
};

/// A point: the state and the velocities.
struct Place {
  Vector x, v;
};

/// The equations in units of their own: states and velocities by the sizes that they have where the
/// iteration starts, rates and levels by the sizes that they take there. What is small and what is
/// near is asked of these numbers.
class Scaled {
 public:
  Scaled(const Equations& equations, std::size_t velocities, std::mt19937_64& random)
      : equations_(equations), velocities_(static_cast<Eigen::Index>(velocities)) {
    const double norm = equations.start().norm();
    length_ = norm > 0 ? norm : 1;
    constexpr int kSamples = 16;
    for (int k = 0; k < kSamples; ++k) {
      const Place place = random_place(random);
      const Vector sizes = equations.residual(place.x, place.v).cwiseAbs();
      if (!sizes.allFinite()) continue;
      sizes_ = sizes_.size() == 0 ? sizes : Vector(sizes_.cwiseMax(sizes));
    }
    if (sizes_.size() == 0)
      sizes_ = equations.residual(equations.start(), Vector::Zero(velocities_));
    for (double& size : sizes_)
      if (!(size > 0) || !std::isfinite(size)) size = 1;
  }

  double length() const { return length_; }
  /// What a rate is compared with.
  double rate() const {
    return sizes_.head(static_cast<Eigen::Index>(equations_.states())).maxCoeff();
  }

  Place random_place(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    Place place{equations_.start(), Vector::Zero(velocities_)};
    for (double& entry : place.x) entry = length_ * normal(random);
    for (double& entry : place.v) entry = normal(random);
    return place;
  }
  Vector residual(const Place& place) const {
    return equations_.residual(place.x, place.v).cwiseQuotient(sizes_);
  }
  double error(const Place& place) const { return residual(place).lpNorm<Eigen::Infinity>(); }
  Matrix derivative(const Place& place) const {
    Matrix result = sizes_.cwiseInverse().asDiagonal() * equations_.derivative(place.x, place.v);
    result.leftCols(place.x.size()) *= length_;
    return result;
  }
  /// Of points, in units of the states.
  double distance(const Place& a, const Place& b) const {
    return std::max((a.x - b.x).lpNorm<Eigen::Infinity>() / length_,
                    a.v.size() == 0 ? 0 : (a.v - b.v).lpNorm<Eigen::Infinity>());
  }
  /// place + share * (to - place)
  static Place between(const Place& place, const Place& to, double share) {
    return {place.x + share * (to.x - place.x), place.v + share * (to.v - place.v)};
  }
  Place moved(const Place& place, const Vector& step) const {
    return {place.x + length_ * step.head(place.x.size()), place.v + step.tail(place.v.size())};
  }

 private:
  const Equations& equations_;
  Eigen::Index velocities_;
  double length_ = 1;
  Vector sizes_;
};

/// What is left of the equations where they are solved: rounding of their terms.
constexpr double kSolved = 1e-11;
/// Pivots below it are zero: directions in which the equations do not change to first order.
constexpr double kFlat = 1e-8;
/// .. and these are so whatever the equations do nearby: it is rounding of the derivative.
constexpr double kNoChange = 1e-14;
/// Of rates and levels, in their units.
constexpr double kRoundingOfRates = 0x1p-50, kManyRoundings = 10;
constexpr double kNearEachOther = 1e-6;

/// Newton's iteration with the shortest step that the linear equations allow, as long as it makes
/// the residual smaller: at a multiple root it comes nearer by a part each time.
bool approach(const Scaled& equations, Place& place) {
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
void refine(const Scaled& equations, Place& place) {
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

bool solve(const Scaled& equations, Place& place) {
  if (!approach(equations, place)) return false;
  refine(equations, place);
  return true;
}

/// Directions from a solution, a column each.
struct Directions {
  Matrix flat;     ///< in which the equations do not change to first order, as far as can be told
  Matrix regular;  ///< the others, each as long as the solution may be off: by rounding of the
                   ///< equations, and by what is left of them
};

/// Whether the equations change in a direction by so little that rounding may have made it. At a
/// multiple root, or beside a family that is curved, the derivative is another one within what
/// rounding moves the solution; that of equations that are regular and badly conditioned is the
/// same (the quantity of Kantorovich's theorem on Newton's iteration).
/// \param size     of the derivative in this direction
/// \param largest  of its sizes in all directions
bool is_flat(const Scaled& equations, const Place& place, const Matrix& derivative,
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

Directions directions_at(const Scaled& equations, const Place& place) {
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

/// The dimension of the solutions near one that is solved: a flat direction belongs to a family
/// only if there are solutions at some distance that way. The minimum of q^10 is flat, and alone.
std::size_t family_at(const Scaled& equations, const Place& place, std::mt19937_64& random) {
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

/// Whether nothing between two solutions tells them apart: the straight way has no residual.
bool joined_straight(const Scaled& equations, const Place& a, const Place& b) {
  constexpr int kParts = 16;
  for (int k = 1; k < kParts; ++k)
    if (equations.error(Scaled::between(a, b, static_cast<double>(k) / kParts)) > 10 * kSolved)
      return false;
  return true;
}

/// Whether one solution goes over into another through others: short ways towards it, each put back
/// onto the solutions.
bool joined(const Scaled& equations, const Place& a, const Place& b) {
  constexpr int kWays = 60;
  constexpr double kShort = 0.1;
  Place here = a;
  double left = equations.distance(here, b);
  for (int way = 0; way < kWays; ++way) {
    if (left < kNearEachOther) return true;
    Place next = Scaled::between(here, b, std::min(1., kShort / left));
    if (!solve(equations, next)) return false;
    const double still = equations.distance(next, b);
    if (still > left - std::min(0.2 * kShort, left / 4)) return false;
    here = next;
    left = still;
  }
  return false;
}

/// In units in which rows and columns are alike: eigenvalues stay, and its size is one of them.
Matrix balanced(const Matrix& a) {
  const Vector units = balancing_units(a);
  return units.cwiseInverse().asDiagonal() * a * units.asDiagonal();
}

/// Empty where the eigenvalues cannot be computed.
std::optional<Equilibrium> described(const Equations& equations, const Scaled& scaled,
                                     const Place& place) {
  const auto& [x, v] = place;
  Equilibrium result;
  result.state.assign(x.data(), x.data() + x.size());
  const bool moves =
      v.size() > 0 &&
      equations.rates(x, Vector::Zero(v.size())).lpNorm<Eigen::Infinity>() > 1e-8 * scaled.rate();
  if (moves) result.velocities.assign(v.data(), v.data() + v.size());
  const Matrix linearised = equations.linearised(x, moves ? v : Vector::Zero(v.size()));
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
  double largest = 0, distance = 0;
  for (std::size_t i = 0; i < a.eigenvalues.size(); ++i) {
    distance = std::max(distance, std::abs(a.eigenvalues[i] - b.eigenvalues[i]));
    largest = std::max({largest, std::abs(a.eigenvalues[i]), std::abs(b.eigenvalues[i])});
  }
  return distance <= std::sqrt(kNearEachOther) * largest;
}

/// What was found: equilibria with all points that belong to each.
class Collection {
 public:
  Collection(const Equations& equations, const Scaled& scaled, std::mt19937_64& random)
      : equations_(equations), scaled_(scaled), random_(random) {}

  void add(const Place& place) {
    auto found = described(equations_, scaled_, place);
    if (!found) return;
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

  /// \param assess  completes what is said of each, at the point that stands for it
  std::vector<Equilibrium> equilibria(
      const std::function<void(const Place&, Equilibrium&)>& assess) const {
    std::vector<Equilibrium> result;
    for (const Group& group : groups_) {
      result.push_back(group.first);
      assess(group.points.front(), result.back());  // it was the first
    }
    return result;
  }

 private:
  struct Group {
    Equilibrium first;
    std::vector<Place> points;
  };

  bool belongs(const Equilibrium& found, const Place& place, const Group& group) const {
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

  const Equations& equations_;
  const Scaled& scaled_;
  std::mt19937_64& random_;
  std::vector<Group> groups_;
};

/// Functions that keep their values: all that the model has, and these.
std::vector<GiNaC::ex> all_integrals(const Model& model, std::vector<GiNaC::ex> result) {
  if (model.hamiltonian) result.push_back(*model.hamiltonian);
  for (const auto* more : {&model.casimirs, &model.integrals})
    for (const NamedExpression& function : *more) result.push_back(function.value);
  return result;
}

/// What the linearised equations tell of a solution.
class Assessment {
 public:
  /// \param integrals  functions that keep their values without the velocities
  Assessment(const Model& model, const Scene& scene, const Specialisation& spec,
             const std::vector<GiNaC::ex>& integrals, const Equations& equations,
             const Scaled& scaled, std::mt19937_64& random)
      : equations_(equations),
        scaled_(scaled),
        random_(random),
        bracket_(model, scene),
        forms_(model, scene, integrals),
        kinks_(spec.rhs) {
    constexpr int kTries = 16;
    for (int k = 0; k < kTries && !generic_; ++k)
      generic_ = bracket_.at(scaled.random_place(random).x);
  }

  void operator()(const Place& place, Equilibrium& found) const {
    const Directions directions = directions_at(scaled_, place);
    Place own = place;
    if (found.velocities.empty()) own.v.setZero();
    const std::vector<Place> nearby = indistinguishable(own, directions, found);
    if (has_no_derivative(own, nearby)) {
      found.eigenvalues.clear();
      found.stability = SpectralStability::no_derivative;
      return;
    }
    const Matrix linearised = equations_.linearised(own.x, own.v);
    LinearStructure known = structure(own, directions, found);
    known.forms = [&] { return forms_.at(own.x, linearised); };
    const auto stability = linear_stability(linearised, error_of(linearised, nearby), known);
    if (!stability) return;
    found.eigenvalues = stability->eigenvalues;
    found.stability = stability->stability;
  }

 private:
  /// Points that rounding does not tell from a solution. A multiple root may be anywhere near.
  std::vector<Place> indistinguishable(const Place& place, const Directions& directions,
                                       const Equilibrium& found) const {
    constexpr int kPoints = 8;
    constexpr double kOfMultipleRoot = 1e-5, kFarthestAside = 1e-2;
    std::vector<Place> result;
    for (int k = 0; k < kPoints; ++k) {
      Vector step = Vector::Zero(directions.regular.rows());
      for (const auto& direction : directions.regular.colwise()) step += sign() * direction;
      if (found.family == 0 || scaled_.error(place) > kManyRoundings * kRoundingOfRates)
        for (const auto& direction : directions.flat.colwise())
          step += sign() * kOfMultipleRoot * direction;
      if (step.norm() > kFarthestAside) step *= kFarthestAside / step.norm();
      result.push_back(scaled_.moved(place, step));
      if (found.velocities.empty()) result.back().v.setZero();
    }
    return result;
  }

  double sign() const { return random_() % 2 == 0 ? -1 : 1; }

  /// Of each entry: that of its own rounding, and what it changes by to the points nearby.
  Matrix error_of(const Matrix& linearised, const std::vector<Place>& nearby) const {
    constexpr double kOfEntry = 0x1p-49, kOfChange = 2;
    Matrix changes = Matrix::Zero(linearised.rows(), linearised.cols());
    for (const Place& other : nearby) {
      const Matrix there = equations_.linearised(other.x, other.v);
      if (there.allFinite()) changes = changes.cwiseMax((there - linearised).cwiseAbs());
    }
    return kOfEntry * linearised.cwiseAbs() + kOfChange * changes;
  }

  /// Whether the linearised equations are others on the other side, however near: |x|, and not
  /// x|x|.
  bool has_no_derivative(const Place& place, const std::vector<Place>& nearby) const {
    std::vector<std::vector<double>> inputs;
    for (const Place& other : nearby) inputs.push_back(equations_.inputs(other.x, other.v));
    if (!kinks_.are_at(equations_.inputs(place.x, place.v), inputs)) return false;
    constexpr double kNear = 1e-6, kNearer = 1e-9, kStays = 0.1, kSmall = 1e-7;
    const double jump = difference(place, kNearer);
    return jump > kStays * difference(place, kNear) &&
           jump > kSmall * equations_.linearised(place.x, place.v).norm();
  }

  /// The largest difference of the linearised equations across a point.
  double difference(const Place& place, double distance) const {
    constexpr int kWays = 8;
    double result = 0;
    std::normal_distribution<double> normal;
    for (int k = 0; k < kWays; ++k) {
      Vector step = Vector::Zero(place.x.size() + place.v.size());
      for (double& entry : step.head(place.x.size())) entry = normal(random_);
      step *= distance / step.norm();
      const Place one = scaled_.moved(place, step), other = scaled_.moved(place, -step);
      const double change =
          (equations_.linearised(one.x, one.v) - equations_.linearised(other.x, other.v)).norm();
      if (std::isfinite(change)) result = std::max(result, change);
    }
    return result;
  }

  LinearStructure structure(const Place& place, const Directions& directions,
                            const Equilibrium& found) const {
    const auto bracket = bracket_.at(place.x);
    if (bracket && generic_)
      if (const auto result =
              hamiltonian_structure(*bracket, *generic_, null_directions(place, directions, found)))
        return *result;
    if (!found.velocities.empty()) return {};
    // Along the level, whose gradients the linearised equations take to 0 from the left, those of
    // the family are taken to 0.
    const auto n = static_cast<Eigen::Index>(equations_.states());
    const Matrix derivative = scaled_.derivative(place);
    const Matrix gradients = derivative.bottomLeftCorner(derivative.rows() - n, n);
    LinearStructure result;
    result.zeros =
        rank_of_directions(gradients.transpose()) + rank_of_directions(directions.flat.topRows(n));
    return result;
  }

  /// Directions that a power of the linearised equations takes to 0. The flow of a symmetry is one
  /// where the symmetry is an integral of what moves it, as one alone is, or all are at rest; and
  /// what leads to other solutions is taken to a sum of such flows.
  Matrix null_directions(const Place& place, const Directions& directions,
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
    if (all_are_null) take(directions.flat.topRows(n), kSmallPart);
    return columns;
  }

  const Equations& equations_;
  const Scaled& scaled_;
  std::mt19937_64& random_;
  NumericBracket bracket_;
  PreservedForms forms_;
  std::optional<Matrix> generic_;
  Kinks kinks_;
};

}  // namespace

double Equilibrium::growth() const {
  double real = 0;
  for (const auto& value : eigenvalues) real = std::max(real, value.real());
  return real;
}

EquilibriumReport find_equilibria(const Model& model, const Scene& scene,
                                  const std::function<void(double)>& tick) {
  EquilibriumReport report;
  report.symmetry_functions = linear_integrals(model, report.symmetries);
  const std::vector<GiNaC::ex>& integrals = report.symmetry_functions;
  Scene own = scene;
  SpecialiseOptions options;
  options.observe.emplace();
  options.gradients = true;
  const Model extended = with_velocities(model, own, integrals, options.keep_parameters);
  const Specialisation spec = specialise(extended, own, options);
  if (spec.uses_time) throw ModelError("equations that depend on the time have no equilibria");
  for (const std::string& name : spec.invariant_names) {
    if (name == "H") continue;
    const bool symmetry = name.rfind("symmetry_", 0) == 0;
    report.level.push_back(symmetry ? report.symmetries[std::stoul(name.substr(9)) - 1] : name);
  }
  const Equations equations(spec, integrals.size());
  std::mt19937_64 random(1);
  const Scaled scaled(equations, integrals.size(), random);
  Collection collection(equations, scaled, random);
  for (; report.starts < kMostStarts; ++report.starts) {
    tick(static_cast<double>(report.starts) / kMostStarts);
    Place place = scaled.random_place(random);
    if (report.starts == 0) place.x = equations.start();
    if (solve(scaled, place)) collection.add(place);
  }
  report.equilibria = collection.equilibria(
      Assessment(extended, own, spec, all_integrals(model, integrals), equations, scaled, random));
  report.size = scaled.length();
  std::stable_sort(report.equilibria.begin(), report.equilibria.end(),
                   [](const auto& a, const auto& b) { return a.family < b.family; });
  return report;
}

}  // namespace casimir
