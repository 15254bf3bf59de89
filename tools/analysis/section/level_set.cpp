#include "tools/analysis/section/level_set.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

constexpr int kMostStepsToLevel = 60;
/// Of level functions beside their gradients.
constexpr double kLevelMet = 1e-13;
/// Of pivots beside the largest.
constexpr double kSingularLevel = 1e-15;

double wrapped(double value, double period) {
  return period > 0 ? value - period * std::round(value / period) : value;
}

}  // namespace

LevelSet::LevelSet(const SectionProblem& problem)
    : problem_(problem),
      invariants_(problem.run.specialisation.invariants),
      gradients_(problem.run.specialisation.gradients.program),
      rhs_(problem.run.specialisation.rhs),
      inputs_(problem.states() + 1),
      values_(problem.levels.size() + 3),
      entries_(problem.run.specialisation.gradients.program.outputs.size()) {}

void LevelSet::evaluate(const double* x) const {
  std::copy_n(x, problem_.states(), inputs_.begin());
  invariants_(inputs_.data(), values_.data());
}

Eigen::MatrixXd LevelSet::gradients(const Vector& x) const {
  std::copy_n(x.data(), problem_.states(), inputs_.begin());
  gradients_(inputs_.data(), entries_.data());
  const SparseProgram& sparse = problem_.run.specialisation.gradients;
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(x.size(), static_cast<Eigen::Index>(values_.size()));
  for (std::size_t i = 0; i < sparse.entries.size(); ++i)
    result(sparse.entries[i].first, sparse.entries[i].second) = entries_[i];
  return result;
}

bool LevelSet::project(Vector& x, const std::array<double, 2>* pair, bool energy) const {
  const auto levels = plane_index();
  const Eigen::Index rows = levels + 1 + (pair ? 2 : 0);
  Vector residual(rows);
  double before = 0;
  Vector step = Vector::Zero(x.size()), start = x;
  for (int round = 0; round < kMostStepsToLevel; ++round) {
    evaluate(x.data());
    const Eigen::MatrixXd gradient = gradients(x).leftCols(rows);
    for (Eigen::Index i = 0; i < levels; ++i)
      residual[i] =
          values_[static_cast<std::size_t>(i)] - problem_.levels[static_cast<std::size_t>(i)];
    if (!energy) residual[0] = 0;
    residual[levels] = wrapped(values_[static_cast<std::size_t>(levels)], problem_.plane.period);
    for (std::size_t k = 0; pair && k < 2; ++k)
      residual[levels + 1 + static_cast<Eigen::Index>(k)] =
          wrapped(values_[static_cast<std::size_t>(levels) + 1 + k] - (*pair)[k],
                  problem_.plotted[k].period);
    const double size = residual.norm();
    if (!std::isfinite(size) || !gradient.allFinite()) return false;
    const double scale = x.norm();
    bool met = true;
    for (Eigen::Index i = 0; i < rows && met; ++i)
      met = std::abs(residual[i]) <= kLevelMet * (gradient.col(i).norm() * scale + 1e-300);
    if (met) return true;
    // Half a step back where a step has made it worse.
    if (round > 0 && size > 2 * before && step.norm() > 1e-3 * (1 + scale)) {
      step /= 2;
      x = start + step;
      continue;
    }
    before = size;
    start = x;
    Eigen::MatrixXd system = gradient.transpose();
    if (!energy) system.row(0).setZero();
    step = -shortest_solution(system, residual, kSingularLevel);
    const double longest = 0.5 * (1 + scale);
    if (step.norm() > longest) step *= longest / step.norm();
    x += step;
  }
  return false;
}

double LevelSet::distance_from_level(const double* x) const {
  std::vector<SizedNumber> inputs;
  for (std::size_t i = 0; i < problem_.states(); ++i)
    inputs.push_back(Arithmetic<SizedNumber>::plain(x[i]));
  inputs.push_back(Arithmetic<SizedNumber>::plain(0));
  const std::vector<SizedNumber> values =
      casimir::evaluate(problem_.run.specialisation.invariants, inputs);
  double distance = 0;
  for (std::size_t i = 0; i < problem_.levels.size(); ++i) {
    const auto level = static_cast<long double>(problem_.levels[i]);
    const long double size = std::max({std::abs(values[i].size), std::abs(level), 1e-300L});
    const auto here = static_cast<double>(std::abs(values[i].value - level) / size);
    if (!(here <= distance)) distance = here;
  }
  return distance;
}

double LevelSet::energy(const Vector& x) const {
  evaluate(x.data());
  return values_[0];
}

LevelSet::Vector LevelSet::energy_gradient(const Vector& x) const { return gradients(x).col(0); }

LevelSet::Vector LevelSet::field(const Vector& x) const {
  std::copy_n(x.data(), problem_.states(), inputs_.begin());
  Vector f(x.size());
  rhs_(inputs_.data(), f.data());
  return f;
}

LevelSet::Vector LevelSet::plane_gradient(const Vector& x) const {
  return gradients(x).col(plane_index());
}

double LevelSet::speed(const Vector& x) const {
  const Vector f = field(x), gradient = plane_gradient(x);
  const double size = f.norm() * gradient.norm();
  const double rate = size > 0 ? f.dot(gradient) / size : 0;
  return problem_.plane.upwards ? rate : -rate;
}

std::array<double, 2> LevelSet::plotted(const double* x) const {
  evaluate(x);
  std::array<double, 2> result{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double period = problem_.plotted[k].period;
    double value = values_[problem_.levels.size() + 1 + k];
    if (period > 0) {
      value -= period * std::floor(value / period);
      if (value >= period) value = 0;
    }
    result[k] = value;
  }
  return result;
}

Eigen::MatrixXd LevelSet::tangent(const Vector& x) const {
  const Eigen::MatrixXd normal = gradients(x).leftCols(plane_index() + 1);
  return orthogonal_complement(normal, static_cast<Eigen::Index>(problem_.leaf) - 2);
}

LevelSet::Vector LevelSet::difference(const Vector& to, const Vector& from) const {
  const double turn = 2 * std::acos(-1.);
  Vector result = to - from;
  for (Eigen::Index i = 0; i < result.size(); ++i)
    if (problem_.angles[static_cast<std::size_t>(i)]) result[i] = wrapped(result[i], turn);
  return result;
}

}  // namespace casimir
