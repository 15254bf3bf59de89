#pragma once

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "runtime/exact/closed_form.hpp"
#include "runtime/exact/real_lattice.hpp"
#include "runtime/validated/arb_ball.hpp"

namespace casimir::exact {

using Ball = validated::ArbBall;

/// A complex number in a rectangle of two balls.
struct ComplexBall {
  Ball re, im;
  friend ComplexBall operator+(const ComplexBall& a, const ComplexBall& b) {
    return {a.re + b.re, a.im + b.im};
  }
  friend ComplexBall operator-(const ComplexBall& a, const ComplexBall& b) {
    return {a.re - b.re, a.im - b.im};
  }
  friend ComplexBall operator*(const ComplexBall& a, const ComplexBall& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend ComplexBall operator*(const Ball& a, const ComplexBall& b) { return {a * b.re, a * b.im}; }
};
/// |a|^2.
Ball squared(const ComplexBall& a);
/// \throws std::domain_error  where b contains zero.
ComplexBall operator/(const ComplexBall& a, const ComplexBall& b);
/// exp(i a).
ComplexBall on_circle(const Ball& a);
Ball hyperbolic_cosine(const Ball& a);
Ball hyperbolic_sine(const Ball& a);

/// Bits of the numbers that forms are made of.
inline constexpr slong kFormBits = 1064;
/// A number that is known to `kExactDigits` digits, as the ball that says so.
Ball known(const cln::cl_F& value);
Ball exactly(const TwoDoubles& t);
/// What is left of a number of turns without the whole ones, from -1/2 to 1/2.
Ball part_of_turn(const Ball& turns);

/// Weierstrass's function and its derivative at a real argument other than its poles.
class WeierstrassInBalls {
 public:
  explicit WeierstrassInBalls(const RealLattice& lattice);
  struct Values {
    Ball p, slope;
  };
  /// \throws std::domain_error  where the argument may be a pole.
  Values at(const Ball& t) const;

 private:
  RealLattice::Kind kind_;
  Ball low_, height_, rate_, period_, tau_height_;
};

/// The theta functions of Jacobi number three at z and four at x, and their derivatives, of
/// period 1 (theta_3 = sum q^(n^2) exp(2 i pi n z) with q = exp(i pi tau), and theta_4 with
/// alternating signs), tau = i height.
struct ThetaPair {
  ComplexBall three, three_slope;
  Ball four, four_slope;
};
ThetaPair theta_pair(const ComplexBall& z, const Ball& x, const Ball& tau_height);
/// theta_2' / theta_2 at i y, which is purely imaginary: its imaginary part.
Ball theta_two_slope(const Ball& y, const Ball& tau_height);

/// A closed form that is evaluated in balls, with as many digits as it takes until every state is
/// certain to the last digit of double precision: neither a modulus near 0 or 1 nor a division by
/// what nearly vanishes costs a digit.
class BallForm : public ClosedForm {
 public:
  using Enclosure = std::function<std::vector<Ball>(const Ball& t)>;

  /// \param start      the state at time 0, which need not be asked of the formula.
  /// \param enclosure  the state at another time, in balls of the precision of the thread.
  BallForm(const std::vector<cln::cl_F>& start, Enclosure enclosure, double period, double horizon)
      : enclosure_(std::move(enclosure)), period_(period), horizon_(horizon) {
    for (const cln::cl_F& x : start) start_.push_back(cln::double_approx(x));
  }

  /// \throws std::invalid_argument  where the digits of the form do not suffice.
  void at(const TwoDoubles& elapsed, double* x) const override;
  double period() const override { return period_; }
  double horizon() const override { return horizon_; }
  double error() const override;

 private:
  std::vector<double> start_;
  Enclosure enclosure_;
  double period_, horizon_;
};

}  // namespace casimir::exact
