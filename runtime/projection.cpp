#include "runtime/projection.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/evaluate.hpp"
#include "runtime/program/term_size.hpp"
#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

/// An invariant as near to its level as its terms can be rounded needs nothing.
constexpr long double kRoundingOfProjection = 0x1p-54L;
/// A state is not moved by more than this part of its size: then it is the step that is wrong.
constexpr double kFarthest = 1e-3;
constexpr int kSteps = 3;

}  // namespace

Projector::Projector(Program invariants, std::vector<std::size_t> chosen, const Program& gradients,
                     std::vector<std::pair<int, int>> entries, const std::vector<double>& initial,
                     std::vector<double> parameters)
    : invariants_(std::move(invariants)),
      chosen_(std::move(chosen)),
      gradients_(gradients),
      entries_(std::move(entries)),
      states_(initial.size()),
      angles_(moving_angles(invariants_, initial.size())),
      has_angles_(with_angles(invariants_, angles_)),
      parameters_(std::move(parameters)) {
  const std::vector<double> none(states_, 0);
  std::vector<long double> sizes;
  evaluate(0, initial.data(), none.data(), level_, sizes);
  start_.assign(initial.begin(), initial.end());
  start_.insert(start_.end(), parameters_.begin(), parameters_.end());
  start_.push_back(0);
  double largest = 0;
  for (const double x : initial) largest = std::max(largest, std::abs(x));
  for (const double x : initial) reach_.push_back(std::max(std::abs(x), 1e-3 * largest));
}

void Projector::evaluate(double t, const double* x, const double* carry,
                         std::vector<long double>& values, std::vector<long double>& sizes) const {
  std::vector<SizedNumber> inputs;
  for (std::size_t i = 0; i < states_; ++i)
    inputs.push_back(Arithmetic<SizedNumber>::plain(static_cast<long double>(x[i]) + carry[i]));
  for (const double p : parameters_) inputs.push_back(Arithmetic<SizedNumber>::plain(p));
  inputs.push_back(Arithmetic<SizedNumber>::plain(t));
  const std::vector<SizedNumber> all = casimir::evaluate(invariants_, inputs);
  for (const std::size_t k : chosen_) {
    values.push_back(all[k].value);
    sizes.push_back(std::abs(all[k].size));
  }
  if (angles_.empty() || start_.empty()) return;
  std::vector<long double> here;
  for (const SizedNumber& input : inputs) here.push_back(input.value);
  const std::vector<long double> differences =
      least_differences(invariants_, angles_, start_, here);
  for (std::size_t k = 0; k < chosen_.size(); ++k)
    if (has_angles_[chosen_[k]]) values[k] = level_[k] + differences[chosen_[k]];
}

bool Projector::improve(double t, double* x, double* carry) {
  std::vector<long double> values, sizes;
  evaluate(t, x, carry, values, sizes);
  bool needed = false;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const long double gap = std::abs(values[k] - level_[k]);
    if (!std::isfinite(gap)) return false;
    needed |= gap > kRoundingOfProjection * std::max(sizes[k], std::abs(level_[k]));
  }
  if (!needed) return false;

  const auto rows = static_cast<Eigen::Index>(chosen_.size());
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(states_));
  std::vector<double> inputs(x, x + states_), slopes(entries_.size());
  inputs.insert(inputs.end(), parameters_.begin(), parameters_.end());
  inputs.push_back(t);
  gradients_(inputs.data(), slopes.data());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const auto& [state, invariant] = entries_[k];
    const auto row = std::ranges::find(chosen_, static_cast<std::size_t>(invariant));
    if (row == chosen_.end()) continue;
    scaled(row - chosen_.begin(), state) = slopes[k] * reach_[static_cast<std::size_t>(state)];
  }
  Eigen::VectorXd gap(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const double norm = scaled.row(k).norm();
    const double unit = norm > 0 && std::isfinite(norm) ? norm : 1;
    scaled.row(k) /= unit;
    gap[k] = static_cast<double>((level_[index] - values[index]) / unit);
  }
  if (!scaled.allFinite() || !gap.allFinite()) return false;
  const Eigen::VectorXd move = shortest_solution(scaled, gap, 1e-8);
  if (!move.allFinite() || move.lpNorm<Eigen::Infinity>() > kFarthest) return false;
  for (std::size_t i = 0; i < states_; ++i) {
    const double y = move[static_cast<Eigen::Index>(i)] * reach_[i] + carry[i];
    const double sum = x[i] + y, part = sum - x[i];
    carry[i] = (x[i] - (sum - part)) + (y - part);
    x[i] = sum;
  }
  return true;
}

void Projector::operator()(double t, double* x, double* carry) {
  for (std::size_t i = 0; i < states_; ++i) reach_[i] = std::max(reach_[i], std::abs(x[i]));
  for (int step = 0; step < kSteps && improve(t, x, carry); ++step) {
  }
}

}  // namespace casimir
