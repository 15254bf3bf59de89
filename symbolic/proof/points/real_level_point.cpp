#include "symbolic/proof/points/real_level_point.hpp"

#include <arb_mat.h>

#include <algorithm>

#include "symbolic/algebra/exact_constant.hpp"
#include "symbolic/algebra/where_defined.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

constexpr long kNewtonBits = 128;

/// A scoped matrix of real balls.
class BallMatrix {
 public:
  BallMatrix(std::size_t rows, std::size_t columns) {
    arb_mat_init(value_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  ~BallMatrix() { arb_mat_clear(value_); }
  BallMatrix(const BallMatrix&) = delete;
  BallMatrix& operator=(const BallMatrix&) = delete;
  arb_ptr at(std::size_t i, std::size_t j) { return arb_mat_entry(value_, i, j); }
  arb_mat_struct* raw() { return value_; }

 private:
  arb_mat_t value_;
};

/// Equations in as many of the symbols: Newton's method, and its proof that there is a solution
/// (Moore 1977: if x - J(X)^-1 f(x) lies inside the box X around x, then it contains a zero of f).
class Newton {
 public:
  Newton(const FunctionRing& ring, BallEvaluator::Numbers numbers, const std::vector<ex>& functions,
         std::vector<ex> start)
      : ring_(ring), numbers_(numbers), functions_(functions), point_(std::move(start)) {}

  /// An evaluator at a box with a zero; empty where none was proved. \throws NotCertified
  std::optional<BallEvaluator> solve() {
    if (!choose_unknowns()) return std::nullopt;
    constexpr int kSteps = 40;
    const std::size_t k = functions_.size();
    for (int i = 0; i < kSteps; ++i) {
      BallMatrix step(k, 1);
      if (!newton_step(at(x_), at(x_), step)) return std::nullopt;
      bool small = true;
      for (std::size_t j = 0; j < k; ++j) {
        Ball& x = x_[j];
        arb_sub(acb_realref(x.raw()), acb_realref(x.raw()), step.at(j, 0), kNewtonBits);
        mag_zero(arb_radref(acb_realref(x.raw())));
        if (!x.is_finite()) return std::nullopt;
        small = small && arf_cmpabs_2exp_si(arb_midref(step.at(j, 0)), -100) < 0;
      }
      if (small) break;
    }
    std::vector<Ball> box = x_;
    for (Ball& x : box) {
      arb_add_error_2exp_si(acb_realref(x.raw()), -60);
    }
    BallMatrix step(k, 1);
    if (!newton_step(at(box), at(x_), step)) return std::nullopt;
    std::vector<Ball> image = x_;
    for (std::size_t j = 0; j < k; ++j) {
      auto* x = acb_realref(image[j].raw());
      arb_sub(x, x, step.at(j, 0), kNewtonBits);
      if (arb_contains_interior(acb_realref(box[j].raw()), x) == 0) return std::nullopt;
    }
    return at(image);
  }

 private:
  BallEvaluator at(const std::vector<Ball>& moved) const {
    BallEvaluator result(numbers_, kNewtonBits);
    for (std::size_t i = 0; i < point_.size(); ++i) {
      const auto place = std::find(unknowns_.begin(), unknowns_.end(), i);
      if (place == unknowns_.end())
        result.set(ring_.symbols()[i], point_[i]);
      else
        result.set(ring_.symbols()[i], moved[static_cast<std::size_t>(place - unknowns_.begin())]);
    }
    return result;
  }

  /// The symbols in whose columns the Jacobian at the start has the largest pivots.
  bool choose_unknowns() {
    const std::size_t k = functions_.size();
    const std::size_t n = point_.size();
    BallEvaluator start(numbers_, kNewtonBits);
    for (std::size_t i = 0; i < n; ++i) start.set(ring_.symbols()[i], point_[i]);
    std::vector<std::vector<double>> matrix(k, std::vector<double>(n));
    for (std::size_t i = 0; i < k; ++i) {
      slopes_.emplace_back();
      for (std::size_t j = 0; j < n; ++j) {
        slopes_.back().push_back(functions_[i].diff(ring_.symbols()[j]));
        matrix[i][j] = arf_get_d(arb_midref(acb_realref(start(slopes_[i][j]).raw())), ARF_RND_NEAR);
      }
    }
    for (std::size_t row = 0; row < k; ++row) {
      std::size_t best_row = row;
      std::size_t best = 0;
      for (std::size_t i = row; i < k; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (std::abs(matrix[i][j]) > std::abs(matrix[best_row][best])) best_row = i, best = j;
      const double pivot = matrix[best_row][best];
      if (!(std::abs(pivot) > 1e-9)) return false;
      std::swap(matrix[row], matrix[best_row]);
      unknowns_.push_back(best);
      for (std::size_t i = 0; i < k; ++i) {
        const double factor = matrix[i][best] / pivot;
        for (std::size_t j = 0; j < n && i > row; ++j) matrix[i][j] -= factor * matrix[row][j];
        if (i > row) matrix[i][best] = 0;
      }
    }
    for (const std::size_t i : unknowns_) {
      x_.push_back(start(ring_.symbols()[i]));
      mag_zero(arb_radref(acb_realref(x_.back().raw())));
    }
    return true;
  }

  /// J(X)^-1 f(x); false where a ball of the matrix is singular.
  bool newton_step(BallEvaluator slopes_at, BallEvaluator values_at, BallMatrix& step) const {
    const std::size_t k = functions_.size();
    BallMatrix jacobian(k, k);
    BallMatrix values(k, 1);
    for (std::size_t i = 0; i < k; ++i) {
      arb_set(values.at(i, 0), acb_realref(values_at(functions_[i]).raw()));
      for (std::size_t j = 0; j < k; ++j)
        arb_set(jacobian.at(i, j), acb_realref(slopes_at(slopes_[i][unknowns_[j]]).raw()));
    }
    return arb_mat_solve(step.raw(), jacobian.raw(), values.raw(), kNewtonBits) != 0;
  }

  const FunctionRing& ring_;
  BallEvaluator::Numbers numbers_;
  const std::vector<ex>& functions_;
  std::vector<ex> point_;
  std::vector<std::vector<ex>> slopes_;
  std::vector<std::size_t> unknowns_;
  std::vector<Ball> x_;
};

}  // namespace

std::optional<BallEvaluator> RealLevelPoints::find(const Level& level,
                                                   const std::vector<ex>& expressions,
                                                   bool differentiable) {
  differentiable_ = differentiable;
  if (auto point = at_simple_point(level, expressions)) return point;
  if (auto point = at_rational_point(level, expressions)) return point;
  constexpr int kStarts = 60;
  if (real_.numbers() == BallEvaluator::Numbers::complex) return std::nullopt;
  for (int i = 0; i < kStarts; ++i) {
    std::optional<BallEvaluator> box = near(level, real_.draw());
    if (box && admits(*box, expressions)) return box;
  }
  return std::nullopt;
}

bool RealLevelPoints::admits(BallEvaluator& at, const std::vector<ex>& expressions) const {
  return real_.admits(at, expressions) && (!differentiable_ || at.smooth());
}

std::optional<BallEvaluator> RealLevelPoints::at_rational_point(
    const Level& level, const std::vector<ex>& expressions) {
  constexpr int kPoints = 12;
  for (int i = 0; i < kPoints; ++i) {
    const auto point = exact_.rational(level);
    if (!point) return std::nullopt;
    std::vector<ex> coordinates;
    for (std::size_t k = 0; k < ring_.symbols().size(); ++k)
      coordinates.emplace_back(GiNaC::numeric((*point)[k]));
    RealPoint real = real_.at(std::move(coordinates));
    if (admits(real.evaluator(), expressions)) return std::move(real.evaluator());
  }
  return std::nullopt;
}

/// The states of scenes; zeros, ones and other small numbers: singular levels, such as q^2 + p^2 =
/// 0, have no other points.
std::optional<BallEvaluator> RealLevelPoints::at_simple_point(const Level& level,
                                                              const std::vector<ex>& expressions) {
  for (std::vector<ex>& scene : real_.scenes()) {
    if (auto point = on(std::move(scene), level, expressions)) return point;
  }
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<ex> coordinates = real_.draw_simple(trial % 2 == 1);
    if (trial == 0) coordinates.assign(coordinates.size(), 0);
    if (auto point = on(std::move(coordinates), level, expressions)) return point;
  }
  return std::nullopt;
}

std::optional<BallEvaluator> RealLevelPoints::on(std::vector<ex> coordinates, const Level& level,
                                                 const std::vector<ex>& expressions) {
  const auto point_on_it = [&]() -> std::optional<BallEvaluator> {
    RealPoint point = real_.at(std::move(coordinates));
    const bool on_level =
        std::all_of(level.functions.begin(), level.functions.end(), [&](const ex& f) {
          if (const auto exact = point.evaluator().exact(f)) return cln::zerop(*exact);
          if (!point.evaluator()(f).contains_zero()) return false;
          const auto value = exact_constant(substituted(f, values_of(point), real_.limits()));
          return value && value->zero;
        });
    if (on_level && admits(point.evaluator(), expressions)) return std::move(point.evaluator());
    return std::nullopt;
  };
  try {
    return where_defined(point_on_it).value_or(std::nullopt);
  } catch (const NotCertified&) {
    return std::nullopt;
  } catch (const TooLarge&) {
    return std::nullopt;
  }
}

GiNaC::exmap RealLevelPoints::values_of(const RealPoint& point) const {
  GiNaC::exmap values;
  for (std::size_t i = 0; i < ring_.symbols().size(); ++i)
    values[ring_.symbols()[i]] = point.coordinates()[i];
  return values;
}

std::optional<BallEvaluator> RealLevelPoints::near(const Level& level,
                                                   const std::vector<ex>& start) {
  try {
    return Newton(ring_, real_.numbers(), level.functions, start).solve();
  } catch (const NotCertified&) {
    return std::nullopt;
  }
}

}  // namespace casimir
