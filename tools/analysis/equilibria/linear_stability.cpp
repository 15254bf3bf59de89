#include "tools/analysis/equilibria/linear_stability.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "runtime/step/dense.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "tools/analysis/equilibria/eigenvalue_discs.hpp"

namespace casimir {
namespace {

using Discs = std::vector<EigenvalueDisc>;

/// Pivots of brackets and of directions below it, relative to the largest, are zero.
constexpr double kNoPivot = 1e-9, kNoDirection = 1e-6;

/// Where the eigenvalues of a group of discs are.
enum class Position { left, right, axis, zero, undecided };

/// The columns that lie in the leaf.
Eigen::MatrixXd along_leaf(const Eigen::MatrixXd& bracket, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), 0);
  for (const Eigen::VectorXd column : columns.colwise()) {
    const Eigen::VectorXd left = column - bracket * shortest_solution(bracket, column, kNoPivot);
    if (left.norm() > kNoDirection * column.norm()) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + 1);
    result.rightCols(1) = column;
  }
  return result;
}

/// The rank of the symplectic form on columns in the leaf.
std::size_t rank_of_form(const Eigen::MatrixXd& bracket, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd form(columns.cols(), columns.cols());
  double largest = 0;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const Eigen::VectorXd image = shortest_solution(bracket, columns.col(j), kNoPivot);
    form.col(j) = columns.transpose() * image;
    largest = std::max(largest, image.norm());
  }
  if (form.size() == 0 || form.cwiseAbs().maxCoeff() <= kNoDirection * largest) return 0;
  return static_cast<std::size_t>(rank_of(form, kNoDirection));
}

/// An orthonormal basis of the span of independent columns (Gram and Schmidt, twice).
Eigen::MatrixXcd orthonormal(Eigen::MatrixXcd columns) {
  for (int round = 0; round < 2; ++round)
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      for (Eigen::Index i = 0; i < j; ++i)
        columns.col(j) -= columns.col(i) * columns.col(i).dot(columns.col(j));
      columns.col(j).normalize();
    }
  return columns;
}

/// The numbers of GiNaC refuse to underflow; what is so small changes neither ranks nor forms.
GiNaC::exmap values_at(const std::vector<GiNaC::symbol>& variables, const Eigen::VectorXd& state) {
  constexpr double kVanishing = 1e-30, kLeast = 1e-100;
  const double least = std::max(kVanishing * state.norm(), kLeast);
  GiNaC::exmap result;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const double value = state(static_cast<Eigen::Index>(i));
    result[variables[i]] = std::abs(value) > least ? value : 0;
  }
  return result;
}

/// Empty where it has no value, or one that no double holds.
std::optional<double> number(const GiNaC::ex& e, const GiNaC::exmap& values) {
  const auto evaluate = [&]() -> std::optional<double> {
    const GiNaC::ex value = e.subs(values).evalf();
    if (!GiNaC::is_a<GiNaC::numeric>(value)) return std::nullopt;
    const auto& exact = GiNaC::ex_to<GiNaC::numeric>(value);
    return exact.is_real() ? std::optional(exact.to_double()) : std::nullopt;
  };
  return where_defined(evaluate).value_or(std::nullopt);
}

/// The gradient and the second derivatives; empty where they have no values.
std::optional<std::pair<Eigen::VectorXd, Eigen::MatrixXd>> two_derivatives(
    const GiNaC::ex& f, const std::vector<GiNaC::symbol>& variables, const GiNaC::exmap& values) {
  const auto n = static_cast<Eigen::Index>(variables.size());
  std::pair<Eigen::VectorXd, Eigen::MatrixXd> result{n, Eigen::MatrixXd(n, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const GiNaC::ex derivative = f.diff(variables[static_cast<std::size_t>(i)]);
    const auto first = number(derivative, values);
    if (!first) return std::nullopt;
    result.first(i) = *first;
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto second = number(derivative.diff(variables[static_cast<std::size_t>(j)]), values);
      if (!second) return std::nullopt;
      result.second(i, j) = result.second(j, i) = *second;
    }
  }
  return result;
}

/// The eigenvalues of one matrix in their discs.
class Groups {
 public:
  Groups(const Eigen::MatrixXd& a, const Eigen::MatrixXd& error, const LinearStructure& structure,
         Discs discs)
      : a_(a), error_(error), structure_(structure), discs_(std::move(discs)) {}

  LinearStability stability() const {
    LinearStability result;
    std::vector<Position> positions;
    for (const EigenvalueDisc& disc : discs_) positions.push_back(position_of(members(disc.group)));
    if (is_last_pair(positions))
      std::ranges::replace(positions, Position::undecided, Position::axis);
    for (std::size_t k = 0; k < discs_.size(); ++k)
      result.eigenvalues.push_back(without_error(discs_[k], positions[k]));
    const bool right = std::ranges::count(positions, Position::right) > 0,
               undecided = std::ranges::count(positions, Position::undecided) > 0;
    result.stability = right       ? SpectralStability::unstable
                       : undecided ? SpectralStability::undecided
                                   : SpectralStability::stable;
    return result;
  }

 private:
  Discs members(std::size_t group) const {
    Discs result;
    std::ranges::copy_if(discs_, std::back_inserter(result),
                         [&](const auto& disc) { return disc.group == group; });
    return result;
  }

  std::complex<double> without_error(const EigenvalueDisc& disc, Position position) const {
    if (position == Position::zero) return 0;
    const double real = disc.value.real(), imaginary = disc.value.imag();
    constexpr double kVanishing = 1e-60;  // what an iteration towards 0 leaves of it
    const double small = std::max(disc.radius, kVanishing * a_.norm());
    const bool no_real = position == Position::axis || std::abs(real) <= small;
    return {no_real ? 0 : real, std::abs(imaginary) <= small ? 0 : imaginary};
  }

  Position position_of(const Discs& group) const {
    const auto all = [&](const auto& condition) { return std::ranges::all_of(group, condition); };
    if (all([](const auto& disc) { return disc.centre.real() > disc.radius; }))
      return Position::right;
    if (all([](const auto& disc) { return disc.centre.real() < -disc.radius; }))
      return Position::left;
    const bool around_zero = std::ranges::any_of(
        group, [](const auto& disc) { return std::abs(disc.centre) <= disc.radius; });
    if (around_zero && (structure_.zeros >= group.size() ||
                        all([](const auto& disc) { return disc.radius == 0; })))
      return Position::zero;
    const bool mirrored =
        structure_.mirrored || all([](const auto& disc) { return disc.mirrored; });
    if (mirrored && group.size() == 1 && meets_only_own_image(group.front())) return Position::axis;
    if (structure_.mirrored && !around_zero &&
        std::ranges::all_of(group, [&](const auto& disc) { return meets_only_own_image(disc); }) &&
        has_one_signature(group))
      return Position::axis;
    return has_definite_integral(group) ? Position::axis : Position::undecided;
  }

  /// Whether all are on the axis but for two that are conjugate to each other, and the real parts
  /// add up to 0 because no state acts on itself.
  bool is_last_pair(const std::vector<Position>& positions) const {
    if ((a_.cwiseAbs() + error_).trace() > 0) return false;
    Discs open;
    for (std::size_t k = 0; k < discs_.size(); ++k) {
      if (positions[k] == Position::undecided) open.push_back(discs_[k]);
      if (positions[k] == Position::left || positions[k] == Position::right) return false;
    }
    return open.size() == 2 && open[0].group != open[1].group &&
           std::ranges::all_of(open, [](const EigenvalueDisc& disc) {
             return std::abs(disc.centre.imag()) > disc.radius;
           });
  }

  /// Whether the image of a disc at the imaginary axis meets no other group.
  bool meets_only_own_image(const EigenvalueDisc& disc) const {
    return std::ranges::all_of(discs_, [&](const EigenvalueDisc& other) {
      return other.group == disc.group ||
             std::abs(other.centre + std::conj(disc.centre)) > other.radius + disc.radius;
    });
  }

  /// Whether i x* J^-1 x is definite on the eigenvectors of a group.
  bool has_one_signature(const Discs& group) const {
    const Eigen::VectorXd units = balancing_units(a_.cwiseAbs() + error_);
    const Eigen::MatrixXcd vectors = eigenvectors(group, units);
    if (vectors.size() == 0 || !vectors.allFinite()) return false;
    const Eigen::MatrixXcd bracket = structure_.bracket.cast<std::complex<double>>();
    Eigen::MatrixXcd images(vectors.rows(), vectors.cols());
    for (Eigen::Index j = 0; j < vectors.cols(); ++j) {
      const Eigen::VectorXcd original = units.asDiagonal() * vectors.col(j);
      images.col(j) = units.asDiagonal() * shortest_solution(bracket, original, kNoPivot);
    }
    images *= std::complex<double>(0, 1);
    return is_definite(adjoint_times(vectors, images), images.colwise().norm().maxCoeff());
  }

  /// Whether a sum of the preserved forms is definite on the eigenvectors of a group.
  bool has_definite_integral(const Discs& group) const {
    if (!structure_.forms) return false;
    const std::vector<Eigen::MatrixXd> forms = structure_.forms();
    const Eigen::VectorXd units = balancing_units(a_.cwiseAbs() + error_);
    const Eigen::MatrixXcd vectors = eigenvectors(group, units);
    if (forms.empty() || vectors.size() == 0 || !vectors.allFinite()) return false;
    std::vector<Eigen::MatrixXcd> images;
    for (const Eigen::MatrixXd& form : forms) {
      const Eigen::MatrixXd scaled = units.asDiagonal() * form * units.asDiagonal();
      Eigen::MatrixXcd image(vectors.rows(), vectors.cols());
      image.real() = times(scaled, vectors.real());
      image.imag() = times(scaled, vectors.imag());
      images.push_back(std::move(image));
      const double size = images.back().norm();
      if (size > 0) images.back() /= size;
    }
    constexpr int kSums = 100;
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (int k = 0; k < kSums; ++k) {
      Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(vectors.rows(), vectors.cols());
      for (const Eigen::MatrixXcd& image : images) sum += normal(random) * image;
      if (is_definite(adjoint_times(vectors, sum), sum.colwise().norm().maxCoeff())) return true;
    }
    return false;
  }

  /// Of a Hermitian form on vectors that are known to the error over the distance of the other
  /// eigenvalues.
  static bool is_definite(const Eigen::MatrixXcd& form, double largest) {
    constexpr double kCertain = 1e-3;
    const auto values = eigenvalues_of(form);
    if (!values) return false;
    const Eigen::VectorXd real = values->real();
    return std::max(real.minCoeff(), -real.maxCoeff()) > kCertain * largest;
  }

  /// An orthonormal basis of the space of the eigenvectors of a group, in these units.
  Eigen::MatrixXcd eigenvectors(const Discs& group, const Eigen::VectorXd& units) const {
    const Eigen::MatrixXd balanced = units.cwiseInverse().asDiagonal() * a_ * units.asDiagonal();
    const auto system = eigen_system_of(balanced.cast<std::complex<double>>());
    if (!system) return {};
    std::complex<double> mean = 0;
    for (const EigenvalueDisc& disc : group) mean += disc.centre;
    mean /= static_cast<double>(group.size());
    std::vector<Eigen::Index> order(static_cast<std::size_t>(a_.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {},
                      [&](Eigen::Index k) { return std::abs(system->values(k) - mean); });
    order.resize(group.size());
    return orthonormal(system->right(Eigen::all, order));
  }

  const Eigen::MatrixXd &a_, &error_;
  const LinearStructure& structure_;
  Discs discs_;
};

}  // namespace

std::string to_string(SpectralStability stability) {
  switch (stability) {
    case SpectralStability::stable:
      return "spectrally stable";
    case SpectralStability::unstable:
      return "unstable";
    case SpectralStability::no_derivative:
      return "no derivative";
    default:
      return "not decided";
  }
}

NumericBracket::NumericBracket(const Model& model, const Scene& scene)
    : variables_(model.variables) {
  if (!model.poisson) return;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    entries_.emplace_back();
    for (std::size_t j = 0; j < i; ++j)
      entries_.back().push_back(model.at_parameters((*model.poisson)(i, j), scene));
  }
}

std::optional<Eigen::MatrixXd> NumericBracket::at(const Eigen::VectorXd& state) const {
  if (entries_.empty()) return std::nullopt;
  const GiNaC::exmap values = values_at(variables_, state);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(state.size(), state.size());
  for (std::size_t i = 0; i < entries_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto value = number(entries_[i][j], values);
      if (!value) return std::nullopt;
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      result(row, column) = *value;
      result(column, row) = -*value;
    }
  return result;
}

PreservedForms::PreservedForms(const Model& model, const Scene& scene,
                               std::vector<GiNaC::ex> integrals)
    : variables_(model.variables), integrals_(std::move(integrals)) {
  for (GiNaC::ex& integral : integrals_) integral = model.at_parameters(integral, scene);
}

std::vector<Eigen::MatrixXd> PreservedForms::at(const Eigen::VectorXd& state,
                                                const Eigen::MatrixXd& linearised) const {
  const GiNaC::exmap values = values_at(variables_, state);
  Eigen::MatrixXd gradients(state.size(), 0);
  std::vector<Eigen::MatrixXd> second;
  for (const GiNaC::ex& integral : integrals_) {
    const auto derivatives = two_derivatives(integral, variables_, values);
    if (!derivatives) continue;
    gradients.conservativeResize(Eigen::NoChange, gradients.cols() + 1);
    gradients.rightCols(1) = derivatives->first;
    second.push_back(derivatives->second);
  }
  if (second.empty()) return {};
  constexpr double kRounding = 1e-11;
  const auto [sizes, factors] = singular_directions_of(gradients);
  std::vector<Eigen::MatrixXd> result;
  for (Eigen::Index k = 0; k < factors.cols(); ++k) {
    if (sizes(k) > kRounding * std::max(1., sizes(0))) continue;
    Eigen::MatrixXd form = Eigen::MatrixXd::Zero(state.size(), state.size());
    for (std::size_t i = 0; i < second.size(); ++i)
      form += factors(static_cast<Eigen::Index>(i), k) * second[i];
    const Eigen::MatrixXd image = times(form, linearised);
    const double left = (image.transpose() + image).norm();
    if (form.norm() > 0 && left <= kRounding * form.norm() * linearised.norm())
      result.push_back(form);
  }
  return result;
}

std::optional<LinearStructure> hamiltonian_structure(const Eigen::MatrixXd& bracket,
                                                     const Eigen::MatrixXd& generic,
                                                     const Eigen::MatrixXd& null) {
  const Eigen::Index rank = rank_of(bracket, kNoPivot);
  if (!bracket.allFinite() || bracket.norm() == 0 || rank != rank_of(generic, kNoPivot))
    return std::nullopt;
  const Eigen::MatrixXd along = along_leaf(bracket, null);
  const std::size_t on_leaf = 2 * rank_of_directions(along) - rank_of_form(bracket, along);
  LinearStructure result;
  result.mirrored = true;
  result.zeros = static_cast<std::size_t>(bracket.rows() - rank) + on_leaf;
  result.bracket = bracket;
  return result;
}

std::size_t rank_of_directions(const Eigen::MatrixXd& columns) {
  if (columns.size() == 0 || columns.norm() == 0) return 0;
  return static_cast<std::size_t>(rank_of(columns, kNoDirection));
}

std::optional<LinearStability> linear_stability(const Eigen::MatrixXd& a,
                                                const Eigen::MatrixXd& error,
                                                const LinearStructure& structure) {
  auto discs = eigenvalue_discs(a, error);
  if (!discs) return std::nullopt;
  LinearStability result = Groups(a, error, structure, std::move(*discs)).stability();
  const double size = a.norm(), unit = size > 0 ? 1e5 / size : 1;
  std::ranges::sort(result.eigenvalues, {}, [unit](const std::complex<double>& value) {
    return std::pair(-std::round(value.real() * unit), -value.imag());
  });
  return result;
}

}  // namespace casimir
