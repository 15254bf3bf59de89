// The heavy top of Lagrange, with or without a rotor along its axis, and the spherical pendulum.
#include <cln/real.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "runtime/exact/ball_form.hpp"
#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;

/// A complex number of CLN's floating-point numbers.
struct Pair {
  N re, im;
};

/// Where the momentum M and the direction g stand among the states, the axis last.
struct Places {
  std::array<std::size_t, 3> M, g;
};

/// With the parts across the axis as complex numbers M = M_1 + i M_2, G = g_1 + i g_2, that along
/// it constant in the momentum and q in the direction, the equations are
///
///     M' = -i P M - i r G,   G' = -i B G + i a q M,   q' = a Im(conj(G) M).
///
/// They keep E = |M|^2 + 2 r q / a, n = |G|^2 + q^2 and, with L = (B - P)/a, c = Re(conj(G) M) + L
/// q.
struct Top {
  N P, B, a, r;
  Pair M, G;
  N q, spin;  ///< q at the start, and the momentum along the axis
};

/// Coefficients of the field: P and B are P1 * spin + P0 and so on.
struct Coefficients {
  N P1, P0, B1, B0, a, r;
};

std::vector<int> of_states(std::size_t i, std::optional<std::size_t> j = {}) {
  std::vector<int> exponents(18, 0);
  ++exponents[3 * i];
  if (j) ++exponents[3 * *j];
  return exponents;
}

std::vector<ExactPolynomial> top_field(const Coefficients& c, const Places& at) {
  const auto& [M, g] = at;
  std::vector<ExactPolynomial> field(6);
  const auto set = [&](std::size_t rate, const std::vector<int>& exponents, const N& factor) {
    if (!cln::zerop(factor)) field[rate][exponents] = factor;
  };
  for (const std::size_t k : {0, 1}) {
    const std::size_t other = 1 - k;
    const auto turned = [k](const N& value) { return k == 0 ? value : -value; };
    set(M[k], of_states(M[other], M[2]), turned(c.P1));
    set(M[k], of_states(M[other]), turned(c.P0));
    set(M[k], of_states(g[other]), turned(c.r));
    set(g[k], of_states(g[other], M[2]), turned(c.B1));
    set(g[k], of_states(g[other]), turned(c.B0));
    set(g[k], of_states(g[2], M[other]), turned(-c.a));
    set(g[2], of_states(g[k], M[other]), turned(c.a));
  }
  return field;
}

/// The equations with these places, if they are of that kind.
std::optional<Top> read_at(const Motion& of, const Places& at) {
  const auto& [M, g] = at;
  const auto value = [&](std::size_t rate, const std::vector<int>& exponents) {
    return of.coefficient(rate, exponents);
  };
  const Coefficients c{value(M[0], of_states(M[1], M[2])), value(M[0], of_states(M[1])),
                       value(g[0], of_states(g[1], M[2])), value(g[0], of_states(g[1])),
                       value(g[2], of_states(g[0], M[1])), value(M[0], of_states(g[1]))};
  if (cln::zerop(c.a) || !same_field(of.field, top_field(c, at))) return std::nullopt;
  const auto start = [&](std::size_t i) { return of.initial[i]; };
  const N spin = start(M[2]);
  return Top{c.P1 * spin + c.P0,         c.B1 * spin + c.B0,         c.a,         c.r,
             {start(M[0]), start(M[1])}, {start(g[0]), start(g[1])}, start(g[2]), spin};
}

struct PlacedTop {
  Top top;
  Places at;
};

std::optional<PlacedTop> read_top(const Motion& of) {
  for (const std::size_t momentum : {0, 3})
    for (const std::size_t axis : {2, 0, 1}) {
      Places at;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t which = (axis + 1 + k) % 3;
        at.M[k] = momentum + which;
        at.g[k] = 3 - momentum + which;
      }
      if (const auto top = read_at(of, at)) return PlacedTop{*top, at};
    }
  return std::nullopt;
}

N squared(const Pair& a) { return a.re * a.re + a.im * a.im; }
/// Re(conj(a) b).
N scalar_product(const Pair& a, const Pair& b) { return a.re * b.re + a.im * b.im; }

ComplexBall known(const Pair& a) { return {exact::known(a.re), exact::known(a.im)}; }

/// M, G and q at a time.
struct Moved {
  ComplexBall M, G;
  Ball q;
};

/// In the order of the states.
class InOrder {
 public:
  InOrder(const Places& at, const N& spin, std::function<Moved(const Ball&)> motion)
      : at_(at), spin_(exact::known(spin)), motion_(std::move(motion)) {}
  std::vector<Ball> operator()(const Ball& t) const {
    const Moved now = motion_(t);
    std::vector<Ball> state(6);
    state[at_.M[0]] = now.M.re;
    state[at_.M[1]] = now.M.im;
    state[at_.M[2]] = spin_;
    state[at_.g[0]] = now.G.re;
    state[at_.g[1]] = now.G.im;
    state[at_.g[2]] = now.q;
    return state;
  }

 private:
  Places at_;
  Ball spin_;
  std::function<Moved(const Ball&)> motion_;
};

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// q stays, and M and G turn uniformly.
Recognised steady(const Motion& motion, const Top& top, const Places& at) {
  const N size = squared(top.M);
  // M' = i v M, so v = -P - r G/M where that is real.
  const N v = -top.P - top.r * scalar_product(top.G, top.M) / size;
  const auto turned = [M = known(top.M), G = known(top.G), q = exact::known(top.q),
                       rate = exact::known(v)](const Ball& t) {
    const ComplexBall turn = on_circle(rate * t);
    return Moved{turn * M, turn * G, q};
  };
  const double rate = std::abs(cln::double_approx(v));
  return {
      std::make_shared<BallForm>(motion.initial, InOrder(at, top.spin, turned),
                                 rate > 0 ? 2 * 3.14159265358979 / rate : kUnbounded, kUnbounded),
      ""};
}

/// Without weight, r = 0: M turns with the rate -P, and in the frame that turns with it g' = a g *
/// W with W = (M_1, M_2, L), which stays: g turns about it.
Recognised free_top(const Motion& motion, const Top& top, const Places& at) {
  const N L = (top.B - top.P) / top.a;
  const std::array<N, 3> W{top.M.re, top.M.im, L}, g{top.G.re, top.G.im, top.q};
  const N length = cln::sqrt(W[0] * W[0] + W[1] * W[1] + W[2] * W[2]);
  if (cln::zerop(length)) return steady(motion, top, at);
  std::array<Ball, 3> along, across, third;
  const N part = (W[0] * g[0] + W[1] * g[1] + W[2] * g[2]) / (length * length);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    along[i] = exact::known(part * W[i]);
    across[i] = exact::known(g[i] - part * W[i]);
    third[i] = exact::known((g[j] * W[l] - g[l] * W[j]) / length);
  }
  const auto moved = [along, across, third, M = known(top.M), P = exact::known(top.P),
                      rate = exact::known(top.a * length)](const Ball& t) {
    const ComplexBall turn = on_circle(rate * t), back = on_circle(-(P * t));
    std::array<Ball, 3> now;
    for (std::size_t i = 0; i < 3; ++i)
      now[i] = along[i] + turn.re * across[i] + turn.im * third[i];
    return Moved{back * M, back * ComplexBall{now[0], now[1]}, now[2]};
  };
  const double period = 2 * 3.14159265358979 / std::abs(cln::double_approx(top.a * length));
  return {
      std::make_shared<BallForm>(motion.initial, InOrder(at, top.spin, moved), period, kUnbounded),
      ""};
}

/// Of q'^2 = a^2 ((n - q^2)(E - 2 r q / a) - (c - L q)^2): with q = 2 p / (a r) + s it is
/// p'^2 = 4 p^3 - g2 p - g3.
struct Nutation {
  N E, c, L;
  N s, g2, g3;
  N p, p_slope;   ///< at the start
  N zero_of_M;    ///< p where |M|^2 = 4 (this - p) / a^2 would vanish
  N slope_there;  ///< the imaginary part of p' at that point of the curve, whose real part is 0
  N bend;         ///< of q at the start: q''
};

Nutation nutation_of(const Top& top) {
  const N &a = top.a, &r = top.r, &q = top.q;
  const auto number = [&](int value) { return cln::cl_float(cln::cl_RA(value), a); };
  Nutation result;
  const N L = (top.B - top.P) / a, n = squared(top.G) + q * q,
          E = squared(top.M) + number(2) * r * q / a, c = scalar_product(top.G, top.M) + L * q;
  // f = f3 q^3 + f2 q^2 + f1 q + f0
  const N a2 = a * a, f3 = number(2) * a * r, f2 = -(a2 * (E + L * L)),
          f1 = number(2) * a2 * (c * L - r * n / a), f0 = a2 * (n * E - c * c);
  const N s = -f2 / (number(3) * f3), w = number(2) / (a * r);
  const N value = ((f3 * s + f2) * s + f1) * s + f0,
          slope = (number(3) * f3 * s + number(2) * f2) * s + f1;
  result.E = E;
  result.c = c;
  result.L = L;
  result.s = s;
  result.g2 = -slope / w;
  result.g3 = -value / (w * w);
  result.p = (q - s) / w;
  result.p_slope = a * (top.G.re * top.M.im - top.G.im * top.M.re) / w;
  result.zero_of_M = (a * E / (number(2) * r) - s) / w;
  result.slope_there = -a2 * (r * c - a * L * E / number(2)) / number(2);
  result.bend = ((number(3) * f3 * q + number(2) * f2) * q + f1) / number(2);
  return result;
}

/// From M: r G = i (M' + i P M), and q from E.
Moved completed(const ComplexBall& M, const ComplexBall& slope, const Ball& P, const Ball& r,
                const Ball& a, const Ball& E) {
  const ComplexBall force{slope.re - P * M.im, slope.im + P * M.re};
  return {M, {-(force.im / r), force.re / r}, a * (E - squared(M)) / (r + r)};
}

/// M as a function that turns and pulsates. It obeys M'' = -i (P + B) M' + (P B + r a q) M, so that
/// with M = exp(-i (P + B) t / 2) y it is Lame's equation y'' = (2 p + p_0) y, with p_0 that p at
/// which M would vanish. y is a solution without a partner of its own modulus (Whittaker & Watson
/// 23.7): y = sigma(t + v) / sigma(t) exp(-zeta(v) t), p(v) = p_0, from a time on at which p has
/// its pole. With the period T, p(v) between the two larger roots and t half an imaginary period
/// beside the real axis, that is
///
///     y = C theta_3(x + i u) / theta_4(x) exp(-theta_2'(i u) / theta_2(i u) x),
///     x = (t + t_0) / T,  v = T (1/2 + i u).
class TurningPart {
 public:
  TurningPart(const Top& top, const Nutation& of, const RealLattice& lattice)
      : period_(exact::known(lattice.period)),
        tau_height_(exact::known(height_of_tau(lattice))),
        P_(exact::known(top.P)),
        r_(exact::known(top.r)),
        a_(exact::known(top.a)),
        E_(exact::known(of.E)) {
    const N* const e = lattice.roots;
    // p = e3 + (e2 - e3) sn^2 on the motion, and e1 - (e1 - e2) sn^2 of 1 - m beside it.
    const N unit = lattice.rate * lattice.period;
    start_ = exact::known(
        argument(lattice.functions, {of.p - e[2], e[1] - of.p, e[0] - of.p}, of.p_slope) / unit);
    const JacobiFunctions beside(lattice.functions.complement(), lattice.functions.parameter());
    const N& there = of.zero_of_M;
    const N up =
        argument(beside, {e[0] - there, there - e[1], there - e[2]}, cln::abs(of.slope_there)) /
        unit;
    up_ = exact::known(cln::minusp(of.slope_there) ? -up : up);
    const validated::BallPrecision precision(kFormBits);
    turn_ = -((P_ + exact::known(top.B)) / Ball(2.)) - theta_two_slope(up_, tau_height_) / period_;
    set_factor(top, lattice);
  }

  Moved operator()(const Ball& t) const {
    const auto [value, slope] = pulse(t);
    const ComplexBall turned = on_circle(turn_ * t) * factor_;
    const ComplexBall turning{-(turn_ * value.im), turn_ * value.re};
    return completed(turned * value, turned * (slope + turning), P_, r_, a_, E_);
  }

 private:
  /// Of a point of the curve between two roots, its distances from these and from the third.
  struct Between {
    N first, second, third;
  };
  /// The u with sn(u)^2 = first / (first + second) and the slope 2 (first + second) sn cn
  /// sqrt(third) there, which has digits where the distances have lost them.
  static N argument(const JacobiFunctions& functions, const Between& at, const N& slope) {
    const N one = cln::cl_float(cln::cl_RA(1), slope), two = one + one, four = two + two;
    const N width = at.first + at.second;
    const N product = slope * slope / (four * width * width * at.third);  // sn^2 cn^2
    const N rest = one - four * product;
    const N smaller = two * product / (one + (cln::plusp(rest) ? cln::sqrt(rest) : rest - rest));
    const bool begins = at.first < at.second;
    const N small = cln::sqrt(smaller), large = cln::sqrt(one - smaller);
    const N sine = begins ? small : large, cosine = begins ? large : small;
    return functions.inverse(sine, cln::minusp(slope) ? -cosine : cosine);
  }

  struct Pulse {
    ComplexBall value, slope;
  };
  /// theta_3(x + i u) / theta_4(x) and its derivative by the time.
  Pulse pulse(const Ball& t) const {
    const Ball x = part_of_turn(t / period_ + start_);
    const ThetaPair at = theta_pair({x, up_}, x, tau_height_);
    const Ball inverse = Ball(1.) / at.four;
    const ComplexBall value = inverse * at.three;
    return {value, (inverse / period_) * (at.three_slope - at.four_slope * value)};
  }

  /// From M or, where that may be zero, M' at the start.
  void set_factor(const Top& top, const RealLattice& lattice) {
    const auto [value, slope] = pulse(Ball(0.));
    const ComplexBall M = known(top.M), G = known(top.G);
    const ComplexBall rate{P_ * M.im + r_ * G.im, -(P_ * M.re + r_ * G.re)};
    const ComplexBall beside = slope + ComplexBall{-(turn_ * value.im), turn_ * value.re};
    const double of_value = validated::approximate(exact::squared(value)),
                 of_slope = validated::approximate(exact::squared(beside)) /
                            std::pow(cln::double_approx(lattice.rate), 2);
    factor_ = of_value > of_slope ? M / value : rate / beside;
  }

  Ball period_, tau_height_, P_, r_, a_, E_;
  Ball start_, up_, turn_;
  ComplexBall factor_;
};

/// On a separatrix p goes to its double root e, where M vanishes: y'' = (2 p + e) y with
/// p = e - 3 e / cosh^2 has the solution 1 / cosh that dies out, with the rate sqrt(3 e).
class DyingPart {
 public:
  DyingPart(const Top& top, const Nutation& of, const RealLattice& lattice)
      : P_(exact::known(top.P)),
        r_(exact::known(top.r)),
        a_(exact::known(top.a)),
        E_(exact::known(of.E)),
        rate_(exact::known(lattice.rate)),
        M_(known(top.M)) {
    // tanh is p' / (2 rate (e - p)): with w = 1 / cosh, p' = 6 e rate w^2 tanh and e - p = 3 e w^2.
    const N one = cln::cl_float(cln::cl_RA(1), of.p);
    const N two = one + one;
    const N s = of.p_slope / (two * lattice.rate * (lattice.low - of.p));
    const validated::BallPrecision precision(kFormBits);
    turn_ = -((P_ + exact::known(top.B)) / Ball(2.));
    // 1/cosh(u + d) * cosh(d) = 1 / (cosh u + tanh(d) sinh u)
    tangent_ = exact::known(s);
  }

  Moved operator()(const Ball& t) const {
    const Ball u = rate_ * t, high = hyperbolic_cosine(u), low = hyperbolic_sine(u);
    const Ball below = high + tangent_ * low, value = Ball(1.) / below;
    const Ball slope = -(rate_ * (low + tangent_ * high) * value * value);
    const ComplexBall turned = on_circle(turn_ * t) * M_;
    return completed(value * turned, turned * ComplexBall{slope, turn_ * value}, P_, r_, a_, E_);
  }

 private:
  Ball P_, r_, a_, E_, rate_, turn_, tangent_;
  ComplexBall M_;
};

/// Whether q stays where it is: q' = q'' = 0.
bool is_steady(const Top& top, const Nutation& of) {
  const N size = cln::abs(top.a * top.a) * (cln::abs(of.E) + of.L * of.L) + cln::abs(top.r * top.a);
  const N length = cln::sqrt(squared(top.G) + top.q * top.q);
  return cln::zerop(of.p_slope) && cln::abs(of.bend) <= size * length * undecided_part(size);
}

}  // namespace

Recognised symmetric_top(const Motion& motion) {
  const std::string other =
      "the equations are not those of a heavy top with an axis of symmetry through its weight";
  if (motion.states() != 6) return {nullptr, other};
  const auto found = read_top(motion);
  if (!found) return {nullptr, other};
  const auto& [top, at] = *found;
  if (rests(motion)) return at_rest(motion);
  if (cln::zerop(top.r)) return free_top(motion, top, at);
  const Nutation nutation = nutation_of(top);
  if (is_steady(top, nutation)) return steady(motion, top, at);
  const RealLattice lattice(nutation.g2, nutation.g3);
  using Kind = RealLattice::Kind;
  if (lattice.kind == Kind::three)
    return {std::make_shared<BallForm>(motion.initial,
                                       InOrder(at, top.spin, TurningPart(top, nutation, lattice)),
                                       cln::double_approx(lattice.period), kUnbounded),
            ""};
  const double rate = cln::double_approx(lattice.rate);
  if (lattice.kind == Kind::hyperbolic)
    return {std::make_shared<BallForm>(motion.initial,
                                       InOrder(at, top.spin, DyingPart(top, nutation, lattice)),
                                       10 / rate, kSeparatrixHorizon / (2 * rate)),
            ""};
  return {nullptr, "300 digits do not tell the motion of the axis from a steady one"};
}

}  // namespace casimir::exact
