#include "tools/analysis/horseshoe/numeric_return.hpp"

#include <array>
#include <cmath>

#include "runtime/step/dense.hpp"

namespace casimir::horseshoe {
namespace {

constexpr int kOrderOfReturn = 18, kMaxSteps = 3000;
constexpr double kStepError = 1e-17, kSingularReturn = 1e-13, kPlaneMet = 3e-14;

}  // namespace

/// The series of a solution and of its derivatives by the start, up to a time.
struct NumericReturn::Piece {
  const std::vector<std::vector<double>>* states = nullptr;
  /// Transposed, so that what is added to each other lies side by side; by fours, with zeros below.
  std::vector<NumericReturn::Matrix> tangents;
  double step = 0;
};

NumericReturn::NumericReturn(const SectionSystem& system)
    : system_(system),
      flow_(validated::joined(system.rates, system.jacobian.program, system.jacobian.entries)),
      n_(system.states()),
      jet_(flow_.rates, {}, {}, kOrderOfReturn),
      jet_with_jacobian_(flow_.both, {}, {}, kOrderOfReturn),
      plane_(system.plane),
      constraints_(system.constraints),
      gradients_(system.gradients.program),
      rates_(system.rates) {
  for (const RationalInterval& level : system.levels)
    levels_.push_back(cln::double_approx((level.low + level.high) / 2));
}

namespace {
std::vector<double> with_time(const Eigen::VectorXd& x) {
  std::vector<double> inputs(x.data(), x.data() + x.size());
  inputs.push_back(0);
  return inputs;
}
}  // namespace

std::array<double, 2> NumericReturn::plane(const Vector& x) const {
  std::array<double, 2> both{};
  plane_(with_time(x).data(), both.data());
  return both;
}

NumericReturn::Vector NumericReturn::constraints(const Vector& x) const {
  Vector values(static_cast<Eigen::Index>(levels_.size()) + 1);
  constraints_(with_time(x).data(), values.data());
  for (std::size_t a = 0; a < levels_.size(); ++a)
    values[static_cast<Eigen::Index>(a) + 1] -= levels_[a];
  return values;
}

NumericReturn::Matrix NumericReturn::gradients(const Vector& x) const {
  std::vector<double> entries(system_.gradients.program.outputs.size());
  gradients_(with_time(x).data(), entries.data());
  Matrix result = Matrix::Zero(x.size(), static_cast<Eigen::Index>(levels_.size()) + 1);
  for (std::size_t k = 0; k < entries.size(); ++k)
    result(system_.gradients.entries[k].first, system_.gradients.entries[k].second) = entries[k];
  return result;
}

NumericReturn::Vector NumericReturn::rates(const Vector& x) const {
  Vector f(x.size());
  rates_(with_time(x).data(), f.data());
  return f;
}

NumericReturn::Matrix NumericReturn::tangent(const Vector& x) const {
  return orthogonal_complement(gradients(x), 2);
}

bool NumericReturn::project(Vector& x) const {
  constexpr int kRounds = 40;
  double before = INFINITY;
  for (int round = 0; round < kRounds; ++round) {
    const Vector residual = constraints(x);
    const Matrix gradient = gradients(x);
    if (!residual.allFinite() || !gradient.allFinite()) return false;
    const double size = residual.cwiseAbs().maxCoeff();
    const double rounding = kPlaneMet * (gradient.cwiseAbs().maxCoeff() * x.norm() + 1e-300);
    if (size <= rounding || (round > 4 && size <= 30 * rounding && size >= before)) return true;
    before = size;
    Vector step = shortest_solution(gradient.transpose(), residual, kSingularReturn);
    const double longest = 0.5 * (1 + x.norm());
    if (step.norm() > longest) step *= longest / step.norm();
    x -= step;
  }
  return false;
}

void NumericReturn::expand(const Vector& x, bool with_derivative, Piece& piece) const {
  const std::vector<double> start(x.data(), x.data() + x.size());
  TaylorJet<double>& jet = with_derivative ? jet_with_jacobian_ : jet_;
  piece.states = &jet.expand(0, start);
  double first = 0, last = 0, before = 0;
  for (const std::vector<double>& series : *piece.states) {
    first = std::max({first, std::abs(series[0]), std::abs(series[1])});
    last = std::max(last, std::abs(series[kOrderOfReturn]));
    before = std::max(before, std::abs(series[kOrderOfReturn - 1]));
  }
  const auto reach = [&](double size, int k) {
    return size > 0 ? std::pow(kStepError * first / size, 1. / k) : INFINITY;
  };
  piece.step = std::min({reach(last, kOrderOfReturn), reach(before, kOrderOfReturn - 1), 1e3});
  if (!with_derivative) return;
  const auto n = static_cast<Eigen::Index>(n_), padded = (n + 3) / 4 * 4;
  piece.tangents.resize(kOrderOfReturn + 1);
  for (Matrix& coefficient : piece.tangents) coefficient.setZero(padded, n);
  piece.tangents[0].setIdentity();
  for (std::size_t k = 0; k < kOrderOfReturn; ++k) {
    for (std::size_t e = 0; e < flow_.entries.size(); ++e) {
      const std::vector<double>& series = jet.series_of(flow_.entry_lines[e]);
      const auto [row, column] = flow_.entries[e];
      for (Eigen::Index i = 0; i < padded; i += 4) {
        Eigen::Vector4d sum = piece.tangents[k + 1].col(row).segment<4>(i);
        for (std::size_t j = 0; j <= k; ++j)
          sum += series[j] * piece.tangents[k - j].col(column).segment<4>(i);
        piece.tangents[k + 1].col(row).segment<4>(i) = sum;
      }
    }
    piece.tangents[k + 1] /= static_cast<double>(k + 1);
  }
}

NumericReturn::Vector NumericReturn::at(const Piece& piece, double t) const {
  Vector x(static_cast<Eigen::Index>(n_));
  for (std::size_t i = 0; i < n_; ++i) {
    const std::vector<double>& series = (*piece.states)[i];
    double sum = 0;
    for (std::size_t k = series.size(); k-- > 0;) sum = sum * t + series[k];
    x[static_cast<Eigen::Index>(i)] = sum;
  }
  return x;
}

NumericReturn::Matrix NumericReturn::tangents_at(const Piece& piece, double t) const {
  Matrix sum = piece.tangents.back();
  for (std::size_t k = piece.tangents.size() - 1; k-- > 0;) sum = sum * t + piece.tangents[k];
  return sum.topRows(static_cast<Eigen::Index>(n_)).transpose();
}

/// By Newton's method, and by halves where that leaves the interval.
std::optional<double> NumericReturn::root(const Piece& piece, double from, double to) const {
  double t = 0.5 * (from + to);
  constexpr int kRounds = 80;
  for (int round = 0; round < kRounds; ++round) {
    const auto [value, rate] = plane(at(piece, t));
    if (!std::isfinite(value)) return std::nullopt;
    (value < 0 ? from : to) = t;
    double next = rate > 0 ? t - value / rate : from - 1;
    if (!(next > from && next < to)) next = 0.5 * (from + to);
    if (std::abs(next - t) <= 1e-16 * std::abs(piece.step)) return next;
    t = next;
  }
  return t;
}

/// Looks at some places of the step, which may miss two crossings.
std::optional<double> NumericReturn::crossing(const Piece& piece, bool first) const {
  constexpr int kPlaces = 4;
  double before = first ? 1 : plane(at(piece, 0))[0], from = 0;
  for (int k = 1; k <= kPlaces; ++k) {
    const double t = piece.step * k / kPlaces;
    const double value = plane(at(piece, t))[0];
    if (before < 0 && value >= 0) return root(piece, from, t);
    before = value;
    from = t;
  }
  return std::nullopt;
}

std::optional<Returned> NumericReturn::operator()(const Vector& x, bool with_derivative) const {
  Vector state = x;
  double time = 0;
  const auto n = static_cast<Eigen::Index>(n_);
  Matrix tangents = Matrix::Identity(n, n);
  Piece piece;
  for (int step = 0; step < kMaxSteps; ++step) {
    expand(state, with_derivative, piece);
    if (!(piece.step > 1e-12) || !std::isfinite(piece.step)) return std::nullopt;
    if (const auto t = crossing(piece, step == 0)) {
      Returned result{at(piece, *t), time + *t, {}};
      if (with_derivative) {
        const Vector f = rates(result.state), normal = gradients(result.state).col(0);
        const Matrix moved = tangents_at(piece, *t) * tangents;
        result.derivative = moved - f * (normal.transpose() * moved) / normal.dot(f);
      }
      if (!result.state.allFinite()) return std::nullopt;
      return result;
    }
    if (with_derivative) tangents = tangents_at(piece, piece.step) * tangents;
    state = at(piece, piece.step);
    time += piece.step;
    if (!state.allFinite() || state.norm() > 1e6 * (1 + x.norm())) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace casimir::horseshoe
