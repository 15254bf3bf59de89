#pragma once

#include <ginac/ginac.h>

#include <exception>
#include <optional>
#include <unordered_map>

#include "symbolic/algebra/ball.hpp"

namespace casimir {

/// A function is not shown to have a value at a point: it has none there (a pole, a root or a
/// logarithm that is not real), or the balls are too wide to tell.
struct NotCertified : std::exception {
  const char* what() const noexcept override { return "no certified value"; }
};

/// Evaluates expressions at one point in ball arithmetic. A value is returned only where every part
/// of the expression is certain to have one, so that an expression evaluated here is defined at the
/// point; where numbers are `real`, it is real in all of its parts.
///
/// What is exact stays exact: rational numbers, and roots of those that are powers. So a radicand
/// that is zero is seen to be zero.
class BallEvaluator {
 public:
  enum class Numbers {
    real,    ///< roots and logarithms have to be real
    complex  ///< principal values, as GiNaC has them
  };
  BallEvaluator(Numbers numbers, long bits) : numbers_(numbers), bits_(bits) {}

  /// A symbol's value: an exact constant.
  /// \throws NotCertified
  void set(const GiNaC::symbol& symbol, const GiNaC::ex& value);

  /// A symbol's value that is only known to lie in a ball.
  void set(const GiNaC::symbol& symbol, const Ball& value);

  /// \throws NotCertified
  const Ball& operator()(const GiNaC::ex& expression);

  /// The value where it is rational and known exactly.
  /// \throws NotCertified
  std::optional<cln::cl_RA> exact(const GiNaC::ex& expression);

  /// \throws NotCertified  unless the expression has a value
  void require(const GiNaC::ex& expression) { value(expression); }

  /// -1, 0 or 1 for a real value; empty where it is not certain.
  /// \throws NotCertified
  std::optional<int> sign(const GiNaC::ex& expression);

  long bits() const { return bits_; }

  /// Whether everything that was evaluated is differentiable at the point: no root of zero, no
  /// asin(1), no atan2 on its cut.
  bool smooth() const { return smooth_; }

 private:
  /// An exact number, whose ball is made when it is asked for, or a ball.
  class Value {
   public:
    Value(const cln::cl_RA& number, long bits) : exact(number), bits_(bits) {}
    explicit Value(Ball ball) : ball_(std::move(ball)) {}
    const Ball& ball() const {
      if (!ball_) ball_.emplace(*exact, bits_);
      return *ball_;
    }
    std::optional<cln::cl_RA> exact;

   private:
    mutable std::optional<Ball> ball_;
    long bits_ = 0;
  };
  /// A running sum or product, exact for as long as all that came was exact.
  class Total;
  const Value& value(const GiNaC::ex& e);
  Value evaluate(const GiNaC::ex& e);
  Value number(const cln::cl_RA& exact) const;
  Value constant(const GiNaC::numeric& number) const;
  Value sum(const GiNaC::ex& e);
  Value product(const GiNaC::ex& e);
  Value power(const Value& base, const GiNaC::ex& exponent);
  Value whole_power(const Value& base, const cln::cl_I& exponent) const;
  Value root(const Value& base, unsigned long order);
  Value function(const GiNaC::function& f);
  Value elliptic(const GiNaC::function& f);
  /// asin v, or acos v.
  Value arc_of(const Value& v, bool sine);
  Value angle_of(const Value& y, const Value& x);
  /// \throws NotCertified  unless the sign is known
  int certain_sign(const Value& v) const;
  Value checked(Ball ball) const;

  Numbers numbers_;
  long bits_;
  bool smooth_ = true;
  std::unordered_map<GiNaC::ex, Value> known_;
};

}  // namespace casimir
