#include "tools/analysis/equilibria/eigenvalue_discs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

using Connections = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;
using Members = std::vector<Eigen::Index>;

/// Which states act on which, directly or through others.
Connections reached(Connections acts) {
  for (Eigen::Index k = 0; k < acts.rows(); ++k)
    for (Eigen::Index i = 0; i < acts.rows(); ++i)
      for (Eigen::Index j = 0; j < acts.rows(); ++j)
        acts(i, j) = acts(i, j) || (acts(i, k) && acts(k, j));
  return acts;
}

/// The states, those together that act on each other.
std::vector<Members> blocks_of(const Connections& acts) {
  const Connections all = reached(acts);
  std::vector<Members> result;
  std::vector<bool> placed(static_cast<std::size_t>(acts.rows()), false);
  for (Eigen::Index i = 0; i < acts.rows(); ++i) {
    if (placed[static_cast<std::size_t>(i)]) continue;
    Members block;
    for (Eigen::Index j = i; j < acts.rows(); ++j) {
      if (j != i && !(all(i, j) && all(j, i))) continue;
      block.push_back(j);
      placed[static_cast<std::size_t>(j)] = true;
    }
    result.push_back(block);
  }
  return result;
}

/// Whether signs can be given to the states of a connected block so that only those of different
/// sign act on each other: then R A R = -A with the diagonal matrix R of the signs.
bool changes_sign(const Connections& acts, const Members& block) {
  std::vector<int> signs(static_cast<std::size_t>(acts.rows()), 0);
  const auto sign = [&](Eigen::Index i) -> int& { return signs[static_cast<std::size_t>(i)]; };
  sign(block.front()) = 1;
  Members open{block.front()};
  while (!open.empty()) {
    const Eigen::Index i = open.back();
    open.pop_back();
    for (const Eigen::Index j : block) {
      if (!acts(i, j) && !acts(j, i)) continue;
      if (sign(j) == sign(i)) return false;
      if (sign(j) == 0) {
        sign(j) = -sign(i);
        open.push_back(j);
      }
    }
  }
  return true;
}

/// Each of the values goes to the nearest disc that has none yet.
void assign_values(const Eigen::VectorXcd& values, std::vector<EigenvalueDisc>& discs) {
  std::vector<bool> taken(discs.size(), false);
  for (const std::complex<double>& value : values) {
    std::size_t nearest = discs.size();
    for (std::size_t k = 0; k < discs.size(); ++k)
      if (!taken[k] && (nearest == discs.size() || std::abs(discs[k].centre - value) <
                                                       std::abs(discs[nearest].centre - value)))
        nearest = k;
    taken[nearest] = true;
    discs[nearest].value = value;
  }
}

/// Of one block, without groups.
std::optional<std::vector<EigenvalueDisc>> discs_of_block(Eigen::MatrixXd a,
                                                          Eigen::MatrixXd error) {
  if (a.rows() == 1) return {{{a(0, 0), a(0, 0), error(0, 0)}}};
  const Eigen::VectorXd units = balancing_units(a.cwiseAbs() + error);
  const Eigen::VectorXd inverse = units.cwiseInverse();
  a = inverse.asDiagonal() * a * units.asDiagonal();
  error = inverse.asDiagonal() * error * units.asDiagonal();
  constexpr double kOfIteration = 4 * std::numeric_limits<double>::epsilon();
  error.array() += kOfIteration * a.norm();
  const auto values = eigenvalues_of(a);
  if (!values) return std::nullopt;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) a(i, j) += share(random) * error(i, j);
  const auto system = eigen_system_of(a.cast<std::complex<double>>());
  if (!system) return std::nullopt;
  // Once for the errors, and once for the change that was made.
  const Eigen::MatrixXd moved =
      times(times(system->left.cwiseAbs(), 2 * error), system->right.cwiseAbs());
  std::vector<EigenvalueDisc> result;
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    const double radius = moved.row(k).sum();
    result.push_back({{},
                      system->values(k),
                      std::isfinite(radius) ? radius : std::numeric_limits<double>::infinity()});
  }
  assign_values(*values, result);
  return result;
}

/// Discs that touch become one group.
void group_discs(std::vector<EigenvalueDisc>& discs) {
  for (std::size_t k = 0; k < discs.size(); ++k) discs[k].group = k;
  for (std::size_t k = 0; k < discs.size(); ++k)
    for (std::size_t m = 0; m < k; ++m) {
      const std::size_t from = discs[k].group, to = discs[m].group;
      const double distance = std::abs(discs[k].centre - discs[m].centre);
      if (from == to || !(distance <= discs[k].radius + discs[m].radius)) continue;
      for (EigenvalueDisc& disc : discs)
        if (disc.group == from) disc.group = to;
    }
}

}  // namespace

Eigen::VectorXd balancing_units(Eigen::MatrixXd sizes) {
  constexpr int kMostSweeps = 20;
  Eigen::VectorXd units = Eigen::VectorXd::Ones(sizes.rows());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    for (Eigen::Index i = 0; i < sizes.rows(); ++i) {
      const double diagonal = std::abs(sizes(i, i));
      const double row = sizes.row(i).cwiseAbs().sum() - diagonal,
                   column = sizes.col(i).cwiseAbs().sum() - diagonal;
      if (!(row > 0) || !(column > 0)) continue;
      const double unit = std::exp2(std::round(std::log2(row / column) / 2));
      sizes.row(i) /= unit;
      sizes.col(i) *= unit;
      units(i) *= unit;
    }
  }
  return units;
}

std::optional<std::vector<EigenvalueDisc>> eigenvalue_discs(const Eigen::MatrixXd& a,
                                                            const Eigen::MatrixXd& error) {
  const Connections acts = ((a.cwiseAbs() + error).array() > 0).matrix();
  std::vector<EigenvalueDisc> result;
  for (const Members& block : blocks_of(acts)) {
    auto discs = discs_of_block(a(block, block), error(block, block));
    if (!discs) return std::nullopt;
    const bool mirrored = changes_sign(acts, block);
    for (EigenvalueDisc& disc : *discs) disc.mirrored = mirrored;
    result.insert(result.end(), discs->begin(), discs->end());
  }
  group_discs(result);
  return result;
}

}  // namespace casimir
