// The free rigid body: x_a' = c_a x_b x_d and so on around, by Jacobi's functions.
#include <cln/real.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;

/// x_a = A cn(w t + u), x_b = B sn(w t + u), x_d = D dn(w t + u).
///
/// cn' = -sn dn, sn' = cn dn, dn' = -m sn cn, so these are solutions if -A w = c_a B D,
/// B w = c_b A D and -m D w = c_d A B: that is, with c_a c_b < 0 and c_b c_d <= 0,
/// w^2 = -c_a c_b D^2, B = c_b A D / w, m = c_d A^2 / (c_a D^2). A and D follow from the integrals
/// c_b x_a^2 - c_a x_b^2 and c_b x_d^2 - c_d x_b^2, and m <= 1 decides which of the two axes is a.
class FreeBody : public ClosedForm {
 public:
  struct Axes {
    std::size_t a, b, d;
  };
  FreeBody(const Motion& of, const std::array<N, 3>& c, const Axes& axes) : axes_(axes) {
    const N &xa = of.initial[axes.a], &xb = of.initial[axes.b], &xd = of.initial[axes.d];
    const N &ca = c[axes.a], &cb = c[axes.b], &cd = c[axes.d];
    const N A2 = xa * xa - ca / cb * (xb * xb), D2 = xd * xd - cd / cb * (xb * xb);
    const N A = cln::sqrt(A2), D = cln::minusp(xd) ? -cln::sqrt(D2) : cln::sqrt(D2);
    const N w = cln::sqrt(-ca * cb * D2), B = cb * A * D / w;
    const N m = cd * A2 / (ca * D2), m1 = of.number(1) - m;
    amplitude_ = {cln::double_approx(A), cln::double_approx(B), cln::double_approx(D)};
    rate_ = cln::double_approx(w);
    separatrix_ = cln::abs(m1) < undecided_part(m);
    if (separatrix_) {  // A sech, B tanh, D sech: A has the sign of x_a, and B that of c_b A D
      const N one = of.number(1), side = cln::minusp(xa) ? -one : one, s = side * xb / B;
      amplitude_[0] *= cln::double_approx(side);
      amplitude_[1] *= cln::double_approx(side);
      // Next to the end of the separatrix nothing is left of the way to it.
      start_ = one - cln::abs(s) < vanishing_part(one)
                   ? std::numeric_limits<double>::infinity()
                   : cln::double_approx(cln::ln((one + s) / (one - s)) / of.number(2));
      return;
    }
    functions_ = JacobiFunctions(m, m1);
    const N period = of.number(4) * functions_.quarter();
    phase_ = Phase(w / period, functions_.inverse(xb / B, xa / A) / period);
    period_ = cln::double_approx(period / w);
  }

  void at(const TwoDoubles& elapsed, double* x) const override {
    if (separatrix_) {
      const double u = rate_ * elapsed.high + start_, sech = 1 / std::cosh(u);
      x[axes_.a] = amplitude_[0] * sech;
      x[axes_.b] = amplitude_[1] * std::tanh(u);
      x[axes_.d] = amplitude_[2] * sech;
      return;
    }
    const auto [sn, cn, dn, am] = functions_.at_part(phase_.after(elapsed).part);
    x[axes_.a] = amplitude_[0] * cn;
    x[axes_.b] = amplitude_[1] * sn;
    x[axes_.d] = amplitude_[2] * dn;
  }
  double period() const override { return separatrix_ ? 10 / rate_ : period_; }
  double horizon() const override {
    return separatrix_ ? (kSeparatrixHorizon - std::abs(start_)) / rate_
                       : std::numeric_limits<double>::infinity();
  }
  double error() const override {
    return evaluated_error(separatrix_ ? kSeparatrixHorizon : functions_.four_quarters());
  }
  std::vector<double> reach() const override {
    std::vector<double> result(3);
    result[axes_.a] = std::abs(amplitude_[0]);
    result[axes_.b] = std::abs(amplitude_[1]);
    result[axes_.d] = std::abs(amplitude_[2]);
    return result;
  }

 private:
  Axes axes_;
  std::array<double, 3> amplitude_;
  double rate_ = 0, start_ = 0, period_ = 0;
  bool separatrix_ = false;
  JacobiFunctions functions_;
  Phase phase_;
};

/// The coefficients; nothing where the equations have another term.
std::optional<std::array<N, 3>> coefficients(const Motion& of) {
  std::array<N, 3> c;
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<int> others(9, 0);
    others[3 * ((i + 1) % 3)] = others[3 * ((i + 2) % 3)] = 1;
    c[i] = of.coefficient(i, others);
    if (of.field[i].size() != (cln::zerop(c[i]) ? 0 : 1)) return std::nullopt;
  }
  return c;
}

/// The middle axis b with c_a c_b < 0 and c_b c_d <= 0, and the others in an order with m <= 1.
std::optional<FreeBody::Axes> axes_of(const Motion& of, const std::array<N, 3>& c) {
  for (std::size_t b = 0; b < 3; ++b)
    for (const std::size_t step : {1, 2}) {
      const std::size_t a = (b + step) % 3, d = (b + 3 - step) % 3;
      if (!cln::minusp(c[a] * c[b]) || cln::plusp(c[b] * c[d])) continue;
      const N &xa = of.initial[a], &xb = of.initial[b], &xd = of.initial[d];
      const N A2 = xa * xa - c[a] / c[b] * (xb * xb), D2 = xd * xd - c[d] / c[b] * (xb * xb);
      if (cln::abs(c[d]) * A2 <= cln::abs(c[a]) * D2 * (of.number(1) + undecided_part(D2)))
        return FreeBody::Axes{a, b, d};
    }
  return std::nullopt;
}

}  // namespace

Recognised free_body(const Motion& motion) {
  if (motion.states() != 3) return {nullptr, "there are not three states"};
  const auto c = coefficients(motion);
  if (!c) return {nullptr, "the rates are not products of the other two states"};
  int moving = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (!cln::zerop((*c)[i] * motion.initial[(i + 1) % 3] * motion.initial[(i + 2) % 3])) ++moving;
  if (moving == 0) return at_rest(motion);
  const auto axes = axes_of(motion, *c);
  if (!axes)
    return {nullptr,
            "the coefficients of the three products have signs by which solutions are not bounded"};
  return {std::make_shared<FreeBody>(motion, *c, *axes), ""};
}

}  // namespace casimir::exact
