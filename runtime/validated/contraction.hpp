#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/evaluate.hpp"
#include "runtime/validated/arb_ball.hpp"
#include "runtime/validated/flow_series.hpp"
#include "runtime/validated/frame.hpp"

namespace casimir::validated {

/// A first integral. That it is one is for the caller to prove: what is said here of a function
/// that changes along solutions is false.
struct Integral {
  std::string name;
  Program value;            ///< of the states and the time; one output
  Program gradient;         ///< of the same inputs ..
  std::vector<int> states;  ///< .. and the state that each of its outputs belongs to
};

/// A set of states m + C s + B r: s is what the run began with, C what the flow has made of it, r
/// all else (Lohner's doubletons; Computation and application of Taylor polynomials with interval
/// remainder bounds, and Mrozek & Zgliczynski, Ann. Pol. Math. 74, 237, 2000).
template <class Ball>
struct Doubleton {
  std::vector<Ball> middle;  ///< m, without radius
  Matrix<Ball> carried;      ///< C, without radius; no columns where the start is a point
  std::vector<Ball> start;   ///< s, around zero
  Frame frame;               ///< B
  std::vector<Ball> rest;    ///< r

  /// A box around m, and so convex with it, that contains the set.
  std::vector<Ball> hull() const {
    const std::vector<Ball> by_start = product(carried, start),
                            by_rest = product(frame.columns, rest);
    std::vector<Ball> box = middle;
    for (std::size_t i = 0; i < box.size(); ++i) box[i] = widened(box[i], by_start[i] + by_rest[i]);
    return box;
  }
};

/// y + F y for a matrix F with |F| <= e in the maximum norm: B^-1 w where y contains B^T w.
template <class Ball>
std::vector<Ball> corrected(std::vector<Ball> y, const Frame& frame) {
  Ball size;
  for (const Ball& one : y) size = size + symmetric(one);
  const Ball by = Ball(MidRad(0, frame.defect)) * size;
  for (Ball& one : y) one = one + by;
  return y;
}

/// The derivatives of the states of a set by the states that they began as: M + B R with the frame
/// B of the set.
template <class Ball>
struct Slopes {
  Matrix<Ball> middle;  ///< M, without radius
  Matrix<Ball> rest;    ///< R
};

/// The same for each column of a matrix.
template <class Ball>
Matrix<Ball> corrected(Matrix<Ball> y, const Frame& frame) {
  const Ball defect(MidRad(0, frame.defect));
  for (std::size_t j = 0; j < y.columns; ++j) {
    Ball size;
    for (std::size_t i = 0; i < y.rows; ++i) size = size + symmetric(y(i, j));
    for (std::size_t i = 0; i < y.rows; ++i) y(i, j) = y(i, j) + defect * size;
  }
  return y;
}

/// A program that is evaluated again and again: its constants are made into balls once, at the
/// precision of the thread that makes it.
template <class Ball>
class BallFunction {
 public:
  explicit BallFunction(const Program& program) : program_(program), values_(program.code.size()) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (is_literal(program.code[i]))
        values_[i] = literal_value(program, program.code[i], Arithmetic<Ball>{});
  }

  /// The outputs at the states and the time. \throws std::domain_error
  const std::vector<Ball>& operator()(const std::vector<Ball>& states, const Ball& time) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Instruction& line = program_.code[i];
      if (is_literal(line)) continue;
      if (line.op == Op::input) {
        const auto input = static_cast<std::size_t>(line.a);
        values_[i] = input < states.size() ? states[input] : time;
      } else {
        values_[i] =
            applied(line.op, at(line.a), at(line.b < 0 ? line.a : line.b), Arithmetic<Ball>{});
      }
    }
    outputs_.clear();
    for (const int output : program_.outputs) outputs_.push_back(at(output));
    return outputs_;
  }

 private:
  const Ball& at(int line) const { return values_[static_cast<std::size_t>(line)]; }

  const Program& program_;
  std::vector<Ball> values_, outputs_;
};

/// Thins a set with one integral.
///
/// Let I be constant along the solutions, as it is as long as they stay where it is analytic: that
/// is asked of every piece of the way (`is_analytic_on`), and an integral is given up for good
/// where it is not certain (the angle of a state jumps at its cut, as a logarithm may at a pole).
/// Then every state x of the set has I(x) = c for the c of its start, and by the mean value theorem
///   g (x - m) = c - I(m)   with a g in the gradients over a convex box that contains x and m.
/// With x - m = C s + B r and, for the start m_0 + s, c = I(m_0) + g_0 s,
///   (g B) r = I(m_0) - I(m) + (g_0 - g C) s,
/// an equation for each r_a whose factor (g B)_a is certain not to vanish. Where the start is a
/// point there is no s, and c is computed from the exact data.
template <class Ball>
class Contractor {
 public:
  /// \param bits  of the values at points.
  Contractor(const Integral& integral, slong bits)
      : integral_(integral),
        bits_(bits),
        polynomial_(is_polynomial(integral.value)),
        rational_(is_rational(integral.value)),
        value_(integral.value),
        gradient_(integral.gradient) {}

  const std::string& name() const { return integral_.name; }
  bool usable() const { return usable_; }
  /// Whether every solution so far is certain to have kept the value of the integral that it began
  /// with: that the derivative of a function along solutions vanishes says so only where it is
  /// analytic.
  bool is_kept() const { return rational_ || usable_; }
  bool has_contracted() const { return contracted_; }

  /// Where solutions begin: at that point, or from m in m + s.
  void begin(const std::vector<ArbBall>& point, const std::vector<Ball>& box) {
    try {
      const BallPrecision precision(bits_);
      exact_value_.emplace(integral_.value);
      level_ = (*exact_value_)(point, ArbBall())[0];
      first_gradient_ = gradient_over(box, Ball());
    } catch (const std::domain_error&) {
      usable_ = false;
    }
  }

  /// The same where every solution that counts has a value of the integral within `level`: so
  /// c does not depend on s, of which there are `starts`.
  void begin_on(const ArbBall& level, std::size_t starts) {
    usable_ = true;
    try {
      const BallPrecision precision(bits_);
      if (!exact_value_) exact_value_.emplace(integral_.value);
      level_ = level;
      first_gradient_.assign(starts, Ball());
    } catch (const std::domain_error&) {
      usable_ = false;
    }
  }

  /// Whether the integral is certain to be analytic on a box that solutions go through.
  bool is_analytic_on(const std::vector<Ball>& box, const Ball& time) {
    if (polynomial_) return true;
    try {
      return is_usable(value_(box, time)[0]);
    } catch (const std::domain_error&) {
      return false;
    }
  }
  /// It was not analytic all along.
  void give_up() { usable_ = false; }

  /// The direction that the set is to be thin along, at a point; empty where there is none.
  std::vector<double> direction(const std::vector<Ball>& at, const Ball& time) {
    std::vector<double> result;
    if (!usable_) return result;
    try {
      for (const Ball& entry : gradient_over(at, time)) result.push_back(approximate(entry));
    } catch (const std::domain_error&) {
      result.clear();
    }
    return result;
  }

  /// Makes the coordinate `which` of the set smaller, where the equation does.
  /// \param hull  contains the set and its middle.
  /// \return      false where no state of the set is on the level, which cannot be of an integral.
  bool contract(Doubleton<Ball>& set, std::size_t which, const std::vector<Ball>& hull,
                const Ball& time) {
    std::vector<Ball> gradient;
    Ball right;
    if (!is_analytic_on(hull, time)) return true;
    try {
      gradient = gradient_over(hull, time);
      right = offset(set.middle, time);
    } catch (const std::domain_error&) {
      return true;
    }
    if (!set.start.empty()) {
      const std::vector<Ball> now = product_of(gradient, set.carried);
      for (std::size_t k = 0; k < set.start.size(); ++k)
        right = right + (first_gradient_[k] - now[k]) * set.start[k];
    }
    const std::vector<Ball> factors = product_of(gradient, set.frame.columns);
    for (std::size_t j = 0; j < set.rest.size(); ++j)
      if (j != which) right = right - factors[j] * set.rest[j];
    const Ball& divisor = factors[which];
    if (!is_usable(right) || !is_usable(divisor) || contains_zero(divisor)) return true;
    contracted_ = true;
    return intersect(set.rest[which], right / divisor);
  }

  /// Makes row `which` of the R of derivatives smaller. I(x(t)) = I(x(0)) for all starts near each
  /// start of the run, since I is analytic on a neighbourhood of the way: so, with the gradients g
  /// at x(t) and g_0 at x(0), g W = g_0 for W = M + B R, an equation for each entry of the row.
  /// After a `begin`, and for the set at the same time.
  /// \param hull  contains the set.
  /// \return      false where no derivative of the set obeys it, which cannot be of an integral.
  bool contract_slopes(Slopes<Ball>& slopes, const Doubleton<Ball>& set, std::size_t which,
                       const std::vector<Ball>& hull, const Ball& time) {
    std::vector<Ball> gradient;
    try {
      gradient = gradient_over(hull, time);
    } catch (const std::domain_error&) {
      return true;
    }
    const std::vector<Ball> factors = product_of(gradient, set.frame.columns);
    if (!is_usable(factors[which]) || contains_zero(factors[which])) return true;
    for (std::size_t j = 0; j < slopes.rest.columns; ++j) {
      Ball right = first_gradient_[j];
      for (std::size_t i = 0; i < gradient.size(); ++i)
        right = right - gradient[i] * slopes.middle(i, j);
      for (std::size_t b = 0; b < factors.size(); ++b)
        if (b != which) right = right - factors[b] * slopes.rest(b, j);
      if (is_usable(right) && !intersect(slopes.rest(which, j), right / factors[which]))
        return false;
    }
    return true;
  }

 private:
  /// g A
  template <class Number>
  static std::vector<Ball> product_of(const std::vector<Ball>& g, const Matrix<Number>& a) {
    std::vector<Ball> result(a.columns);
    ProductSums<Ball> sums(a.rows);
    for (std::size_t i = 0; i < a.rows; ++i) {
      sums.begin(g[i]);
      for (std::size_t j = 0; j < a.columns; ++j) sums.add(result[j], a(i, j));
    }
    for (Ball& entry : result) sums.finish(entry);
    return result;
  }

  std::vector<Ball> gradient_over(const std::vector<Ball>& box, const Ball& time) {
    const std::vector<Ball>& entries = gradient_(box, time);
    std::vector<Ball> gradient(box.size());
    for (std::size_t k = 0; k < entries.size(); ++k)
      gradient[static_cast<std::size_t>(integral_.states[k])] = entries[k];
    return gradient;
  }

  /// I(m_0) - I(m), to more digits than the balls have: the difference is a small one.
  Ball offset(const std::vector<Ball>& middle, const Ball& time) {
    const BallPrecision precision(bits_);
    std::vector<ArbBall> states;
    for (const Ball& x : middle) states.emplace_back(x);
    return ball_from<Ball>(level_ - (*exact_value_)(states, ArbBall(time))[0]);
  }

  const Integral& integral_;
  slong bits_;
  bool polynomial_, rational_, usable_ = true, contracted_ = false;
  BallFunction<Ball> value_, gradient_;
  std::optional<BallFunction<ArbBall>> exact_value_;
  ArbBall level_;
  std::vector<Ball> first_gradient_;  ///< g_0, over the starts
};

}  // namespace casimir::validated
