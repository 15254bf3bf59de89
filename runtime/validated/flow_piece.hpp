#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/validated/flow_series.hpp"
#include "runtime/validated/series_sums.hpp"
#include "runtime/validated/tangents.hpp"

namespace casimir::validated {

/// A right-hand side with its Jacobian, as one program whose outputs are the rates.
struct FlowProgram {
  Program rates;                 ///< the inputs are the states and the time
  Program both;                  ///< the same outputs, and lines for the Jacobian
  Entries entries;               ///< of the Jacobian
  std::vector<int> entry_lines;  ///< their lines in `both`
  std::size_t dimension() const { return rates.outputs.size(); }
};

/// Joins a right-hand side and its Jacobian, line by line, each line once.
FlowProgram joined(const Program& rates, const Program& jacobian, const Entries& entries);

/// The solutions that begin in a box, for a stretch of time [0, h]:
///   x(t; x0) = sum_{k <= N} x_k(x0) t^k + x_{N+1}(x(theta)) t^{N+1},
/// each component with a theta of its own in [0, t] (Taylor's theorem). The sum is a function of x0
/// whose derivative is sum V_k t^k, so that for x0 and m in the box X (which is convex)
///   x(t; x0) in sum m_k t^k + (sum V_k(X) t^k) (x0 - m) + x_{N+1}(D) t^{N+1},
/// where D contains the solutions on [0, t]: see `encloses`.
template <class Ball>
class FlowPiece {
 public:
  using Vector = std::vector<Ball>;

  FlowPiece(const FlowProgram& flow, int order, bool forwards)
      : order_(order),
        forwards_(forwards),
        unit_(forwards ? 1. : -1.),
        start_(flow.rates, flow.both, order),
        tube_(flow.rates, order + 1),
        tangents_(flow.entries, flow.dimension(), static_cast<std::size_t>(order)),
        flow_(flow) {
    for (const int line : flow.entry_lines) jacobian_.push_back(&start_.series_of(line));
  }

  /// Expands the solutions from a point and from a box around it.
  /// \param elapsed  since the beginning of the run; the time itself is -elapsed backwards.
  /// \throws std::domain_error  where the equations are not certain to be analytic.
  void expand(const Ball& elapsed, const Vector& middle, const Vector& box) {
    elapsed_ = elapsed;
    start_.expand(unit_ * elapsed, middle, box, unit_);
    centre_ = &start_.of_point();
    all_ = &start_.of_box();
  }

  /// log2 of a step after which the last terms are 2^log2_error of the first ones, and of the size
  /// of these: so far as the coefficients show, which proves nothing. The step is infinite where
  /// the last terms are zero.
  struct Reach {
    double log2_step, log2_size;
  };
  Reach reach(double log2_error) const {
    std::vector<double> sizes(static_cast<std::size_t>(order_) + 1, -INFINITY);
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      if (k > 2 && k + 2 < sizes.size()) continue;
      for (const auto& series : *all_) {
        const double size = log2_magnitude(series[k]);
        // What is zero but for a radius that covers underflow is zero.
        if (k > 0 || size > kNothing) sizes[k] = std::max(sizes[k], size);
      }
    }
    Reach result{-INFINITY, sizes[0]};
    const auto order = static_cast<std::size_t>(order_);
    for (std::size_t first = 0; first < 3; ++first) {
      if (!(sizes[first] > kNothing)) continue;
      double step = INFINITY;
      for (const std::size_t k : {order - 1, order})
        if (sizes[k] > kNothing)
          step = std::min(step,
                          (log2_error + sizes[first] - sizes[k]) / static_cast<double>(k - first));
      result.log2_step = std::max(result.log2_step, step);
    }
    if (std::isinf(result.log2_step)) {
      result.log2_step = INFINITY;  // the series ends, or all is at rest
    } else {
      for (std::size_t k = 1; k < 3; ++k)
        result.log2_size =
            std::max(result.log2_size, sizes[k] + static_cast<double>(k) * result.log2_step);
    }
    if (std::isinf(result.log2_size)) result.log2_size = 0;
    return result;
  }

  /// Whether every solution that begins in the box exists on [0, h] and stays in the tube
  ///   D = sum_{k <= N} X_k [0, h]^k + [-R, R],   R = `room` > 0 in each component:
  /// it is, where |x_{N+1}(D)| h^{N+1} <= R/2 (the high-order enclosure; Corliss & Rihm 1996;
  /// Nedialkov, Jackson & Pryce, Reliable Computing 7, 449, 2001, Thm. 4.1).
  ///
  /// Proof. That the coefficients over D can be formed means that each operation of the program is
  /// analytic on a neighbourhood of what it gets on D, since the arithmetic refuses all else; so
  /// the right-hand side is analytic on a neighbourhood of the compact D. Let T be the supremum of
  /// the t <= h up to which the solution exists and stays in D. It exists at T too, since D is
  /// compact, and by Taylor's theorem on [0, T] it lies at T at the distance R/2 at least from the
  /// faces of D. If T were below h it would stay in D for longer.
  /// \return  log2 of the largest remainder over its bound R/2: not above 0 where it holds. Infinite
  ///          where the coefficients over D cannot be formed.
  double encloses(const Ball& h, const Ball& room) {
    const std::size_t n = all_->size();
    const Ball some_time = from_zero_to(h);
    TubeSum<Ball> sum(*all_, h, static_cast<std::size_t>(order_), room);
    const Ball& power = sum.power;
    Vector& tube = sum.tube;
    for (const Ball& x : tube)
      if (!is_usable(x)) return INFINITY;
    double worst = -INFINITY;
    rest_.resize(n);
    try {
      const auto& series = tube_.expand(unit_ * (elapsed_ + some_time), tube, unit_);
      // Logarithms say by how much, and only balls whether.
      const Ball half = room * Ball(0.5);
      const double bound = log2_magnitude(half);
      for (std::size_t i = 0; i < n; ++i) {
        rest_[i] = series[i].back();
        if (!is_usable(rest_[i])) return INFINITY;
        const Ball remainder = rest_[i] * power;
        const double excess = log2_magnitude(remainder) - bound;
        if (std::isnan(excess)) return INFINITY;
        worst = std::max(
            worst, contains(half, remainder) ? std::min(excess, 0.) : std::max(excess, kBeyond));
      }
    } catch (const std::domain_error&) {
      return INFINITY;
    }
    tube_box_ = std::move(tube);
    return worst;
  }

  /// What all solutions pass on [0, h], after `encloses` has said so.
  const Vector& tube() const { return tube_box_; }

  /// x(t; m) - m for a time t in [0, h], with what x_{N+1} leaves.
  Vector displacement(const Ball& t, bool without_remainder = false) const {
    Vector result = without_remainder ? Vector(rest_.size()) : rest_;
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = horner((*centre_)[i], result[i], t, static_cast<std::size_t>(order_));
    return result;
  }

  /// The derivatives of the Taylor polynomial, before `derivative` is asked for any time.
  void expand_tangents() { tangents_.expand(jacobian_, forwards_); }
  Matrix<Ball> derivative(const Ball& t) const { return tangents_.at(t); }

  /// Encloses the derivatives W(t) of the solutions themselves by the states that they begin with,
  /// for every t in [0, h], after `encloses` has said yes to h and the tangents are expanded.
  ///
  /// Theorem. W is the solution of W' = J(x(t)) W, W(0) = I. Let Q contain V_{N+1}(y) for every y
  /// of the tube D, where V_k(y) are the Taylor coefficients of the derivatives of the solution
  /// that begins in y (at any time of the step), and let R > 0 be a matrix of rooms. If, entry by
  /// entry and with P = sum_{k <= N} V_k(X) [0, h]^k,
  ///   |Q (P + [-R, R])| h^{N+1} <= 3/4 R,
  /// then W(t) is in P + [-R, R] for all t in [0, h], and
  ///   W(t) in sum_{k <= N} V_k(X) t^k + Q (P + [-R, R]) t^{N+1}.
  /// Proof. The equation is linear and x(t) stays in D, where J is analytic: so W exists on [0, h].
  /// From x(s) on the solution is the flow of x(s), so that W(s + t) = V(t; x(s)) W(s): the Taylor
  /// coefficient k of W at s is V_k(x(s)) W(s). Taylor's theorem for each entry, with an s of its
  /// own in [0, t], gives the last line as long as W(s) is in P + [-R, R]. Let T be the supremum of
  /// the times up to which it is; there W is at least R/4 > 0 from the faces, so that T = h.
  /// The rooms follow from the condition itself, by iteration, and need no norm: so states of very
  /// different sizes do not spoil one another.
  /// \return  false where no room is found: the step is too long.
  bool enclose_derivatives(const Ball& h) {
    constexpr int kRounds = 6;
    if (!expand_over_tube(h)) return false;
    const Matrix<Ball> last = tube_tangents_->coefficient(static_cast<std::size_t>(order_) + 1);
    Ball power = h;
    for (int k = 0; k < order_; ++k) power = power * h;
    const Matrix<Ball> sum = derivatives_up_to(h);
    const Ball floor = power_of_two<Ball>(kFloor), share(0.75), twice(2.);
    Matrix<Ball> room(sum.rows, sum.columns);
    for (int round = 0; round < kRounds; ++round) {
      Matrix<Ball> all = sum;
      for (std::size_t i = 0; i < all.entries.size(); ++i)
        all.entries[i] = widened(all.entries[i], room.entries[i]);
      derivative_rest_ = product(last, all);
      bool holds = round > 0;
      for (std::size_t i = 0; i < all.entries.size(); ++i) {
        const Ball rest = derivative_rest_.entries[i] * power;
        if (!is_usable(rest)) return false;
        holds = holds && contains(room.entries[i] * share, rest);
        if (!holds) room.entries[i] = symmetric(symmetric(rest) * twice + floor);
      }
      if (holds) return true;
    }
    return false;
  }

  /// W(t) for a time t in [0, h], after `enclose_derivatives` has said yes.
  Matrix<Ball> whole_derivative(const Ball& t, bool without_remainder = false) const {
    Matrix<Ball> result = tangents_.at(t);
    if (without_remainder) return result;
    Ball power = t;
    for (int k = 0; k < order_; ++k) power = power * t;
    for (std::size_t i = 0; i < result.entries.size(); ++i)
      result.entries[i] = result.entries[i] + derivative_rest_.entries[i] * power;
    return result;
  }

 private:
  /// log2 of what is taken for zero, where the length of a step is guessed.
  static constexpr double kNothing = -950;
  /// log2 of the least excess that is told.
  static constexpr double kBeyond = 0.01;
  /// log2 of what rooms of derivatives are at least: far above what may have underflowed.
  static constexpr int kFloor = -900;

  /// The Taylor coefficients of the Jacobian over the tube, and of the derivatives.
  bool expand_over_tube(const Ball& h) {
    if (!tube_jacobian_) {
      tube_jacobian_.emplace(flow_.both, order_ + 1);
      tube_tangents_.emplace(flow_.entries, flow_.dimension(),
                             static_cast<std::size_t>(order_) + 1);
      for (const int line : flow_.entry_lines)
        tube_entries_.push_back(&tube_jacobian_->series_of(line));
    }
    try {
      tube_jacobian_->expand(unit_ * (elapsed_ + from_zero_to(h)), tube_box_, unit_);
    } catch (const std::domain_error&) {
      return false;
    }
    tube_tangents_->expand(tube_entries_, forwards_);
    return true;
  }

  /// sum_k V_k [0, h]^k
  Matrix<Ball> derivatives_up_to(const Ball& h) const {
    Matrix<Ball> result = tangents_.coefficient(0);
    Ball power(1.);
    for (int k = 1; k <= order_; ++k) {
      power = power * h;
      const Ball up_to = from_zero_to(power);
      const Matrix<Ball> term = tangents_.coefficient(static_cast<std::size_t>(k));
      for (std::size_t i = 0; i < result.entries.size(); ++i)
        result.entries[i] = result.entries[i] + term.entries[i] * up_to;
    }
    return result;
  }

  int order_;
  bool forwards_;
  Ball unit_, elapsed_;
  FlowSeriesPair<Ball> start_;
  FlowSeries<Ball> tube_;
  Tangents<Ball> tangents_;
  std::vector<const std::vector<Ball>*> jacobian_, tube_entries_;
  const FlowProgram& flow_;
  std::optional<FlowSeries<Ball>> tube_jacobian_;  ///< where derivatives are wanted
  std::optional<Tangents<Ball>> tube_tangents_;    ///< the same
  Matrix<Ball> derivative_rest_;                   ///< Q (P + [-R, R])
  const std::vector<Vector>* centre_ = nullptr;
  const std::vector<Vector>* all_ = nullptr;
  Vector rest_, tube_box_;
};

}  // namespace casimir::validated
