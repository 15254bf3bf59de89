#include "tools/analysis/equilibria/relative_equations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/digits/big_float.hpp"
#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/dense.hpp"
#include "tools/analysis/equilibria/newton_solution.hpp"

namespace casimir::equilibria {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

}  // namespace

Equations::Equations(const Specialisation& spec, std::size_t velocities, std::size_t constraints)
    : rates_(spec.rhs),
      levels_(spec.invariants),
      states_(spec.states.size()),
      velocities_(velocities),
      inputs_(spec.rhs.inputs.size(), 0),
      rhs_(spec.rhs),
      jacobian_(spec.jacobian.program),
      invariants_(spec.invariants),
      gradients_(spec.gradients.program),
      jacobian_entries_(spec.jacobian.entries),
      gradient_entries_(spec.gradients.entries),
      all_(spec.invariants.outputs.size()),
      constraints_(constraints) {
  // H is on no level here.
  for (std::size_t i = 0; i < spec.invariant_names.size(); ++i)
    if (spec.invariant_names[i] != "H") level_.push_back(i);
  std::vector<double> start(spec.start.outputs.size());
  Interpreter run(spec.start);
  run(nullptr, start.data());
  start_ = Eigen::Map<Vector>(start.data(), static_cast<Eigen::Index>(states_));
  values_ = invariants(start_, Vector::Zero(static_cast<Eigen::Index>(velocities_)));
}

const std::vector<double>& Equations::inputs(const Vector& x, const Vector& v) const {
  std::copy(x.data(), x.data() + x.size(), inputs_.begin());
  std::copy(v.data(), v.data() + v.size(), inputs_.begin() + static_cast<std::ptrdiff_t>(states_));
  return inputs_;
}

Vector Equations::rates(const Vector& x, const Vector& v) const {
  Vector result(static_cast<Eigen::Index>(states_));
  rhs_(inputs(x, v).data(), result.data());
  return result;
}

Vector Equations::residual(const Vector& x, const Vector& v) const {
  Vector result(static_cast<Eigen::Index>(states_ + level_.size()));
  result << rates(x, v), invariants(x, v) - values_;
  return result;
}

Vector Equations::sizes_of_terms(const Vector& x, const Vector& v) const {
  std::vector<SizedNumber> at;
  for (const double input : inputs(x, v)) at.push_back(Arithmetic<SizedNumber>::plain(input));
  Vector result(static_cast<Eigen::Index>(states_ + level_.size()));
  Eigen::Index k = 0;
  const auto size = [](const SizedNumber& term) {
    return static_cast<double>(std::max(term.size, std::abs(term.value)));
  };
  for (const SizedNumber& rate : evaluate(rates_, at)) result(k++) = size(rate);
  const std::vector<SizedNumber> functions = evaluate(levels_, at);
  for (std::size_t i = 0; i < level_.size(); ++i)
    result(k++) =
        std::max(size(functions[level_[i]]), std::abs(values_(static_cast<Eigen::Index>(i))));
  return result;
}

bool Equations::vanish_by_underflow(const Vector& x, const Vector& v, double near) const {
  constexpr int kLeastExponent = std::numeric_limits<double>::min_exponent;
  const double least = std::numeric_limits<double>::min();
  if ((rates(x, v).cwiseAbs().array() >= least).all()) return false;
  const Precision precision(std::numeric_limits<double>::digits);
  const auto long_rates = [&](const Vector& state) {
    std::vector<BigFloat> at;
    for (const double input : inputs(state, v)) arf_set_d(at.emplace_back().mid(), input);
    return evaluate(rates_, at);
  };
  try {
    const std::vector<BigFloat> here = long_rates(x);
    for (const double side : {-near, near}) {
      const std::vector<BigFloat> there = long_rates((x.array() + side).matrix());
      for (std::size_t i = 0; i < here.size(); ++i) {
        const bool is_small = !here[i].is_zero() && here[i].log2() < kLeastExponent;
        if (is_small && here[i].log2() > (there[i] - here[i]).log2() + 1) return true;
      }
    }
  } catch (const std::domain_error&) {  // beside where the equations have values
  }
  return false;
}

Matrix Equations::by_velocities(const Vector& x, Eigen::Index count) const {
  Matrix result(static_cast<Eigen::Index>(states_), count);
  const Vector base = rates(x, Vector::Zero(count));
  for (Eigen::Index k = 0; k < count; ++k)  // the rates are affine in the velocities
    result.col(k) = rates(x, Vector::Unit(count, k)) - base;
  return result;
}

Matrix Equations::linearised(const Vector& x, const Vector& v) const {
  Matrix result =
      Matrix::Zero(static_cast<Eigen::Index>(states_), static_cast<Eigen::Index>(states_));
  std::vector<double> entries(jacobian_entries_.size());
  jacobian_(inputs(x, v).data(), entries.data());
  for (std::size_t k = 0; k < entries.size(); ++k)
    result(jacobian_entries_[k].first, jacobian_entries_[k].second) = entries[k];
  return result;
}

Matrix Equations::derivative(const Vector& x, const Vector& v) const {
  const auto n = static_cast<Eigen::Index>(states_);
  Matrix result = Matrix::Zero(n + static_cast<Eigen::Index>(level_.size()),
                               n + static_cast<Eigen::Index>(velocities_));
  result.topLeftCorner(n, n) = linearised(x, v);
  result.topRightCorner(n, v.size()) = by_velocities(x, v.size());
  std::vector<double> entries(gradient_entries_.size());
  gradients_(inputs(x, v).data(), entries.data());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto [state, invariant] = gradient_entries_[k];
    const auto place = std::find(level_.begin(), level_.end(), static_cast<std::size_t>(invariant));
    if (place != level_.end()) result(n + (place - level_.begin()), state) = entries[k];
  }
  return result;
}

std::optional<Matrix> Equations::tangent(const Vector& x, const Vector& v) const {
  if (constraints_ == 0) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(states_);
  const auto count = static_cast<Eigen::Index>(constraints_);
  const Matrix gradients =
      derivative(x, v).bottomLeftCorner(static_cast<Eigen::Index>(level_.size()), n).transpose();
  constexpr double kDependentGradients = 1e-10;
  const auto rank = [](const Matrix& columns) {
    return columns.cols() == 0 ? 0 : rank_of(columns, kDependentGradients);
  };
  if (rank(gradients) == rank(gradients.leftCols(gradients.cols() - count))) return std::nullopt;
  const Matrix own = gradients.rightCols(count);
  return orthogonal_complement(own, n - rank(own));
}

Vector Equations::invariants(const Vector& x, const Vector& v) const {
  std::vector<double> values(all_);
  invariants_(inputs(x, v).data(), values.data());
  Vector result(static_cast<Eigen::Index>(level_.size()));
  for (std::size_t i = 0; i < level_.size(); ++i)
    result(static_cast<Eigen::Index>(i)) = values[level_[i]];
  return result;
}

ScaledEquations::ScaledEquations(const Equations& equations, std::size_t velocities,
                                 std::mt19937_64& random)
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
  if (sizes_.size() == 0) sizes_ = equations.residual(equations.start(), Vector::Zero(velocities_));
  for (double& size : sizes_)
    if (!(size > 0) || !std::isfinite(size)) size = 1;
}

double ScaledEquations::rate() const {
  return sizes_.head(static_cast<Eigen::Index>(equations_.states())).maxCoeff();
}

Place ScaledEquations::random_place(std::mt19937_64& random, double size) const {
  std::normal_distribution<double> normal;
  Place place{equations_.start(), Vector::Zero(velocities_)};
  for (double& entry : place.x) entry = size * length_ * normal(random);
  for (double& entry : place.v) entry = normal(random);
  return place;
}

Vector ScaledEquations::units_around(const Place& place) const {
  constexpr double kAside = 0.1;
  constexpr Eigen::Index kPlaces = 4;
  Vector result = sizes_of_terms(place);
  for (Eigen::Index k = 0; k < kPlaces; ++k) {
    Place other = place;  // all coordinates aside: a product of two may be small by either
    for (Eigen::Index i = 0; i < place.x.size(); ++i)
      other.x(i) += (i + k) % 2 == 0 || k / 2 == i % 2 ? kAside * length_ : -kAside * length_;
    result = result.cwiseMax(sizes_of_terms(other));
  }
  for (double& unit : result)
    if (!(unit > 0 && unit < 1)) unit = 1;
  return result;
}

Vector ScaledEquations::residual(const Place& place) const {
  return equations_.residual(place.x, place.v).cwiseQuotient(sizes_);
}

Vector ScaledEquations::sizes_of_terms(const Place& place) const {
  return equations_.sizes_of_terms(place.x, place.v).cwiseQuotient(sizes_);
}

Matrix ScaledEquations::derivative(const Place& place) const {
  Matrix result = sizes_.cwiseInverse().asDiagonal() * equations_.derivative(place.x, place.v);
  result.leftCols(place.x.size()) *= length_;
  return result;
}

bool ScaledEquations::vanish_by_underflow(const Place& place) const {
  return equations_.vanish_by_underflow(place.x, place.v, kRoundingOfPlace * length_);
}

double ScaledEquations::distance(const Place& a, const Place& b) const {
  return std::max((a.x - b.x).lpNorm<Eigen::Infinity>() / length_,
                  a.v.size() == 0 ? 0 : (a.v - b.v).lpNorm<Eigen::Infinity>());
}

Place ScaledEquations::between(const Place& place, const Place& to, double share) {
  return {place.x + share * (to.x - place.x), place.v + share * (to.v - place.v)};
}

Place ScaledEquations::moved(const Place& place, const Vector& step) const {
  return {place.x + length_ * step.head(place.x.size()), place.v + step.tail(place.v.size())};
}

double ScaledEquations::error(const Place& place) const {
  return residual(place).lpNorm<Eigen::Infinity>();
}

}  // namespace casimir::equilibria
