#include "runtime/exact/ball_form.hpp"

#include <acb_elliptic.h>
#include <acb_modular.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

/// Complex numbers of Arb's, side by side.
class ComplexArray {
 public:
  explicit ComplexArray(slong size) : size_(size), values_(_acb_vec_init(size)) {}
  ~ComplexArray() { _acb_vec_clear(values_, size_); }
  ComplexArray(const ComplexArray&) = delete;
  ComplexArray& operator=(const ComplexArray&) = delete;

  void set(slong at, const ComplexBall& value) {
    arb_set(acb_realref(values_ + at), value.re.raw());
    arb_set(acb_imagref(values_ + at), value.im.raw());
  }
  ComplexBall get(slong at) const {
    ComplexBall result;
    arb_set(result.re.raw(), acb_realref(values_ + at));
    arb_set(result.im.raw(), acb_imagref(values_ + at));
    return result;
  }
  acb_ptr at(slong index) { return values_ + index; }

 private:
  slong size_;
  acb_ptr values_;
};

/// The four theta functions at z with their derivatives: two numbers for each.
void thetas(ComplexArray& values, const ComplexBall& z, const Ball& tau_height) {
  ComplexArray arguments(2);
  arguments.set(0, z);
  arguments.set(1, {Ball(0.), tau_height});
  acb_modular_theta_jet(values.at(0), values.at(2), values.at(4), values.at(6), arguments.at(0),
                        arguments.at(1), 2, Ball::precision());
}

template <class Function>
Ball with_function(Function function, const Ball& a) {
  Ball result;
  function(result.raw(), a.raw(), Ball::precision());
  return result;
}

/// The state that these balls are, where they say it well enough.
bool settled(const std::vector<Ball>& state, double* x) {
  constexpr double kOfItself = 1e-17, kOfLargest = 1e-19;
  double largest = 0;
  for (const Ball& at : state) {
    if (arb_is_finite(at.raw()) == 0) return false;
    largest = std::max(largest, std::abs(validated::approximate(at)));
  }
  for (std::size_t i = 0; i < state.size(); ++i) {
    x[i] = arb_contains_zero(state[i].raw()) != 0 ? 0 : validated::approximate(state[i]);
    if (validated::radius_of(state[i]) > std::max(kOfItself * std::abs(x[i]), kOfLargest * largest))
      return false;
  }
  return true;
}

/// The numbers are made of intermediate results with that many bits that are certain.
constexpr slong kCertainBits = 850;
constexpr slong kFirstBits = 106, kMostBits = kFormBits;

}  // namespace

Ball squared(const ComplexBall& a) { return a.re * a.re + a.im * a.im; }

ComplexBall operator/(const ComplexBall& a, const ComplexBall& b) {
  const Ball size = squared(b);
  const ComplexBall product = a * ComplexBall{b.re, -b.im};
  return {product.re / size, product.im / size};
}

ComplexBall on_circle(const Ball& a) {
  ComplexBall result;
  arb_sin_cos(result.im.raw(), result.re.raw(), a.raw(), Ball::precision());
  return result;
}

Ball hyperbolic_cosine(const Ball& a) { return with_function(arb_cosh, a); }

Ball hyperbolic_sine(const Ball& a) { return with_function(arb_sinh, a); }

Ball known(const cln::cl_F& value) {
  const validated::BallPrecision precision(kFormBits);
  Ball result(cln::rational(value));
  if (!cln::zerop(value)) {
    Ball error;
    arb_mul_2exp_si(error.raw(), result.raw(), -kCertainBits);
    arb_add_error(result.raw(), error.raw());
  }
  return result;
}

Ball exactly(const TwoDoubles& t) {
  Ball result(t.high);
  const Ball low(t.low);
  arb_add(result.raw(), result.raw(), low.raw(), ARF_PREC_EXACT);
  return result;
}

Ball part_of_turn(const Ball& turns) {
  arf_t whole;
  arf_init(whole);
  const Ball half(0.5);
  arf_add(whole, arb_midref(turns.raw()), arb_midref(half.raw()), ARF_PREC_EXACT, ARF_RND_NEAR);
  arf_floor(whole, whole);
  Ball result;
  arb_sub_arf(result.raw(), turns.raw(), whole, Ball::precision());
  arf_clear(whole);
  return result;
}

WeierstrassInBalls::WeierstrassInBalls(const RealLattice& lattice)
    : kind_(lattice.kind),
      low_(known(lattice.low)),
      height_(known(lattice.height)),
      rate_(known(lattice.rate)),
      period_(known(lattice.period)) {
  if (kind_ == RealLattice::Kind::three || kind_ == RealLattice::Kind::one)
    tau_height_ = known(height_of_tau(lattice));
}

WeierstrassInBalls::Values WeierstrassInBalls::at(const Ball& t) const {
  using Kind = RealLattice::Kind;
  const Ball one(1.), two(2.);
  if (kind_ == Kind::rational) {
    const Ball inverse = one / t, square = inverse * inverse;
    return {square, -(two * square * inverse)};
  }
  if (kind_ == Kind::hyperbolic || kind_ == Kind::circular) {
    const bool turns = kind_ == Kind::circular;
    const Ball s = rate_ * t, below = with_function(turns ? arb_sin : arb_sinh, s);
    const Ball peak = height_ / (below * below);
    const Ball ratio = with_function(turns ? arb_cos : arb_cosh, s) / below;
    return {low_ + peak, -(two * rate_ * peak * ratio)};
  }
  ComplexArray arguments(2), values(2);
  arguments.set(0, {part_of_turn(t / period_), Ball(0.)});
  arguments.set(1, {Ball(kind_ == Kind::one ? 0.5 : 0.), tau_height_});
  acb_elliptic_p_jet(values.at(0), arguments.at(0), arguments.at(1), 2, Ball::precision());
  const Ball square = period_ * period_;
  return {values.get(0).re / square, values.get(1).re / (square * period_)};
}

ThetaPair theta_pair(const ComplexBall& z, const Ball& x, const Ball& tau_height) {
  ComplexArray values(8);
  ThetaPair result;
  thetas(values, z, tau_height);
  result.three = values.get(4);
  result.three_slope = values.get(5);
  thetas(values, {x, Ball(0.)}, tau_height);
  result.four = values.get(6).re;
  result.four_slope = values.get(7).re;
  return result;
}

Ball theta_two_slope(const Ball& y, const Ball& tau_height) {
  ComplexArray values(8);
  thetas(values, {Ball(0.), y}, tau_height);
  return values.get(3).im / values.get(2).re;
}

double BallForm::error() const { return kRoundedError; }

void BallForm::at(const TwoDoubles& elapsed, double* x) const {
  if (elapsed.high == 0) {
    std::copy(start_.begin(), start_.end(), x);
    return;
  }
  const Ball t = exactly(elapsed);
  for (slong bits = kFirstBits; bits <= kMostBits; bits *= 2) {
    const validated::BallPrecision precision(bits);
    try {
      if (settled(enclosure_(t), x)) return;
    } catch (const std::domain_error&) {  // it may divide by zero: with more digits it does not
    }
  }
  throw std::invalid_argument(
      "exact: the digits that the closed form was made of do not give the state at that time; "
      "another method can be had");
}

}  // namespace casimir::exact
