// The pendulum: q'' = -w^2 sin(q - q0), by Jacobi's functions.
#include <cln/real.h>

#include <cmath>
#include <limits>

#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;

/// With y = (q - q0)/2 and k^2 = (q'/(2 w))^2 + sin(y)^2, which is constant:
/// k < 1: sin y = k sn(w t + u, k), q' = 2 w k cn;
/// k > 1: sin y = sn(k w t + u, 1/k) and y = am, q' = 2 w k dn, with k of the sign of q'.
/// k = 1: sin y = tanh(w t + u), q' = 2 w sech, with w of the sign of q'.
class Pendulum : public ClosedForm {
 public:
  /// \param lowest  the stable angle q0.
  Pendulum(const Motion& of, const N& a, const N& w, const N& lowest)
      : lowest_(cln::double_approx(lowest)) {
    const N &q = of.initial[0], one = of.number(1), two = of.number(2);
    const N pi = cln::pi(q);
    // y from -Pi/2 to Pi/2, and the half turns that were taken off.
    const N y = (q - lowest) / two;
    const cln::cl_I turns = cln::round1(y / pi);
    turns_ = cln::double_approx(turns);
    const N reduced = y - pi * cln::cl_float(turns, y);
    const N s = cln::cl_float(cln::sin(reduced), q), c = cln::cl_float(cln::cos(reduced), q);
    const N rate = a * of.initial[1], half = rate / (two * w);
    const N k2 = half * half + s * s;
    momentum_ = 1 / cln::double_approx(a);
    const N rest = cln::abs(one - k2);
    if (rest < undecided_part(q)) {
      kind_ = Kind::separatrix;
      signed_rate_ = cln::double_approx(cln::minusp(rate) ? -w : w);
      const N side = cln::minusp(rate) ? -s : s;
      start_ = cln::double_approx(cln::ln((one + side) / (one - side)) / two);
    } else if (k2 < one) {
      kind_ = Kind::swing;
      functions_ = JacobiFunctions(k2, one - k2);
      const N k = cln::sqrt(k2), period = of.number(4) * functions_.quarter();
      modulus_ = cln::double_approx(k);
      signed_rate_ = cln::double_approx(w);
      phase_ = Phase(w / period, functions_.inverse(s / k, half / k) / period);
      period_ = cln::double_approx(period / w);
    } else {
      kind_ = Kind::round;
      const N m = one / k2, k = cln::minusp(rate) ? -cln::sqrt(k2) : cln::sqrt(k2);
      functions_ = JacobiFunctions(m, (k2 - one) / k2);
      const N period = of.number(4) * functions_.quarter();
      signed_rate_ = cln::double_approx(k * w);
      phase_ = Phase(k * w / period, functions_.inverse(s, c) / period);
      period_ = cln::double_approx(cln::abs(period / (k * w)));
    }
  }

  void at(const TwoDoubles& elapsed, double* x) const override {
    constexpr double kPi = 3.14159265358979323846;
    double y, rate;
    if (kind_ == Kind::separatrix) {
      // y - Pi/2 goes to nothing: 2 atan(tanh(u/2)), which is asin(tanh u).
      const double u = signed_rate_ * elapsed.high + start_sign() * start_;
      y = 2 * std::atan(std::tanh(u / 2));
      rate = 2 * signed_rate_ / std::cosh(u);
    } else {
      const auto [part, whole] = phase_.after(elapsed);
      const auto [sn, cn, dn, am] = functions_.at_part(part);
      if (kind_ == Kind::swing) {
        y = std::atan2(modulus_ * sn, dn);
        rate = 2 * signed_rate_ * modulus_ * cn;
      } else {
        y = am + 2 * kPi * whole;
        rate = 2 * signed_rate_ * dn;
      }
    }
    x[0] = lowest_ + 2 * (y + kPi * turns_);
    x[1] = rate * momentum_;
  }
  double period() const override {
    return kind_ == Kind::separatrix ? 10 / std::abs(signed_rate_) : period_;
  }
  double horizon() const override {
    return kind_ == Kind::separatrix
               ? (kSeparatrixHorizon - std::abs(start_)) / std::abs(signed_rate_)
               : std::numeric_limits<double>::infinity();
  }
  double error() const override {
    return evaluated_error(kind_ == Kind::separatrix ? kSeparatrixHorizon
                                                     : functions_.four_quarters());
  }
  std::vector<double> reach() const override {
    constexpr double kPi = 3.14159265358979323846;
    const double modulus = kind_ == Kind::swing ? modulus_ : 1;
    return {std::abs(lowest_) + kPi * (1 + 2 * std::abs(turns_)),
            2 * std::abs(signed_rate_ * modulus * momentum_)};
  }

 private:
  enum class Kind { swing, round, separatrix };
  double start_sign() const { return signed_rate_ < 0 ? -1 : 1; }

  Kind kind_ = Kind::swing;
  double lowest_, turns_ = 0, momentum_ = 1, modulus_ = 0, signed_rate_ = 0, start_ = 0,
                  period_ = 0;
  JacobiFunctions functions_;
  Phase phase_;
};

}  // namespace

Recognised pendulum(const Motion& motion) {
  const std::string other = "the equations are not q' = a p, p' = b sin q + c cos q";
  if (motion.states() != 2) return {nullptr, other};
  const N a = motion.coefficient(0, {0, 0, 0, 1, 0, 0});
  const N b = motion.coefficient(1, {0, 1, 0, 0, 0, 0}),
          c = motion.coefficient(1, {0, 0, 1, 0, 0, 0});
  const std::size_t terms = (cln::zerop(b) ? 0 : 1) + (cln::zerop(c) ? 0 : 1);
  if (cln::zerop(a) || terms == 0 || motion.field[0].size() != 1 || motion.field[1].size() != terms)
    return {nullptr, other};
  // q'' = a (b sin q + c cos q) = -w^2 sin(q - q0) with w^2 cos q0 = -a b, w^2 sin q0 = a c.
  const N x = -a * b, y = a * c, strength = cln::sqrt(x * x + y * y);
  const N lowest = cln::cl_float(cln::atan(x, y), x);
  const N &q = motion.initial[0], force = cln::abs(cln::cl_float(cln::sin(q - lowest), q));
  if (cln::zerop(motion.initial[1]) && force < undecided_part(q)) return at_rest(motion);
  return {std::make_shared<Pendulum>(motion, a, cln::sqrt(strength), lowest), ""};
}

}  // namespace casimir::exact
