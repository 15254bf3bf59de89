// One degree of freedom in a potential of degree four or less, by Weierstrass's function.
#include <cln/real.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/exact/real_lattice.hpp"
#include "runtime/exact/shapes.hpp"

namespace casimir::exact {
namespace {

using N = cln::cl_F;

/// k times a number, as a number of its kind.
N times(int k, const N& a) { return cln::cl_float(cln::cl_RA(k), a) * a; }

/// Weierstrass's function of a real argument and its derivative, of real invariants: the solution
/// of p'^2 = 4 p^3 - g2 p - g3 with a pole at 0 (Abramowitz & Stegun 18.9).
class Weierstrass {
 public:
  Weierstrass(const N& g2, const N& g3) : Weierstrass(g2, RealLattice(g2, g3)) {}

  struct Values {
    double p, slope;
  };
  /// Nothing near the poles, which are the whole periods. `t` becomes the time from the nearest.
  std::optional<Values> operator()(TwoDoubles& t) const {
    double part = 0;  // of the period
    if (kind_ != Kind::rational && kind_ != Kind::hyperbolic) {
      part = phase_.after(t).part;
      t = {part * period_, 0};
    }
    constexpr double kNear = 1e-7;
    const double u = rate_ * t.high;
    if (std::abs(u) < kNear) return std::nullopt;
    return at(t.high, u, part);
  }

  double period() const { return period_; }
  bool separatrix() const { return kind_ == Kind::hyperbolic; }
  double rate() const { return rate_; }
  double g2() const { return g2_; }
  /// The largest that Jacobi's functions are asked for.
  double argument() const { return separatrix() ? kSeparatrixHorizon : functions_.four_quarters(); }

 private:
  using Kind = RealLattice::Kind;

  Weierstrass(const N& g2, const RealLattice& lattice)
      : kind_(lattice.kind),
        low_(cln::double_approx(lattice.low)),
        height_(cln::double_approx(lattice.height)),
        rate_(cln::double_approx(lattice.rate)),
        g2_(cln::double_approx(g2)),
        functions_(lattice.functions) {
    if (!lattice.periodic()) return;
    const N one = cln::cl_float(cln::cl_RA(1), g2), zero = cln::cl_float(cln::cl_RA(0), g2);
    phase_ = Phase(one / lattice.period, zero);
    period_ = cln::double_approx(lattice.period);
  }

  Values at(double t, double u, double part) const {
    if (kind_ == Kind::rational) return {1 / (t * t), -2 / (t * t * t)};
    if (kind_ == Kind::hyperbolic || kind_ == Kind::circular) {
      const bool turns = kind_ == Kind::circular;
      const double s = turns ? std::sin(u) : std::sinh(u), c = turns ? std::cos(u) : std::cosh(u);
      const double inverse = c / s;
      return {low_ + height_ / (s * s), -2 * rate_ * height_ * inverse / (s * s)};
    }
    if (kind_ == Kind::three) {  // half a period of sn^2: a quarter of its argument to each side
      const auto [sn, cn, dn, am] = functions_.at_part(part / 2);
      return {low_ + height_ / (sn * sn), -2 * rate_ * height_ * cn * dn / (sn * sn * sn)};
    }
    const auto [sn, cn, dn, am] = functions_.at_part(part);
    const double rest = cn > 0 ? sn * sn / (1 + cn) : 1 - cn;  // 1 - cn
    return {low_ + height_ * (1 + cn) / rest, -2 * rate_ * height_ * sn * dn / (rest * rest)};
  }

  Kind kind_ = Kind::rational;
  double low_ = 0, height_ = 0, rate_ = 1, g2_ = 0;
  double period_ = std::numeric_limits<double>::infinity();
  JacobiFunctions functions_;
  Phase phase_;
};

/// A polynomial of degree four: f[k] is its derivative of order k at a point.
struct Quartic {
  N f[5];
};

/// The solution of q'^2 = f(q) from q(0) with q'(0) = v, v^2 = f(q(0)) (Biermann 1865; Whittaker &
/// Watson, A Course of Modern Analysis, 20.6, example 2): with p the function of Weierstrass of the
/// invariants of f, c = f''/24, and all derivatives at q(0),
///
///     q = q(0) + (-v p' + f'/2 (p - c) + f f'''/24) / (2 (p - c)^2 - f f''''/48).
///
/// It is symmetric in the roots of f and needs none of them.
class Biermann : public ClosedForm {
 public:
  Biermann(const Quartic& at, const N& start, const N& v, const N& a)
      : function_(g2(at), g3(at)),
        start_(cln::double_approx(start)),
        v_(cln::double_approx(v)),
        c_(part(at.f[2], 24)),
        slope_(part(at.f[1], 2)),
        bend_(part(at.f[0] * at.f[3], 24)),
        last_(part(at.f[0] * at.f[4], 48)),
        momentum_(1 / cln::double_approx(a)),
        lost_(lost_digits()) {}

  void at(const TwoDoubles& elapsed, double* x) const override {
    TwoDoubles t = elapsed;
    const auto values = function_(t);
    if (!values) {  // the series: what is left out is less than the last digit
      const double s = t.high, third = 12 * c_ * v_, fourth = 12 * (bend_ + c_ * slope_);
      x[0] = start_ + s * (v_ + s * (slope_ / 2 + s * third / 6));
      x[1] = (v_ + s * (slope_ + s * (third / 2 + s * fourth / 6))) * momentum_;
      return;
    }
    const auto [p, p1] = *values;
    const double w = p - c_, p2 = 6 * p * p - function_.g2() / 2;
    const double above = -v_ * p1 + slope_ * w + bend_, below = 2 * w * w - last_;
    const double above1 = -v_ * p2 + slope_ * p1, below1 = 4 * w * p1;
    x[0] = start_ + above / below;
    x[1] = (above1 - above / below * below1) / below * momentum_;
  }
  double period() const override {
    return function_.separatrix() ? 10 / function_.rate() : function_.period();
  }
  double horizon() const override {
    return function_.separatrix() ? kSeparatrixHorizon / (2 * function_.rate())
                                  : std::numeric_limits<double>::infinity();
  }
  /// How much cancellation costs, beside the size of the motion.
  double lost() const { return lost_; }
  double error() const override {
    constexpr double kOfQuotient = 10;  // of two values of the function
    return std::max(kOfQuotient * evaluated_error(function_.argument()), lost_);
  }

 private:
  /// What is left of the digits where p comes so near to c that their difference loses them: far
  /// from a start beside an unstable rest. The largest error in the motion beside its size, from
  /// the derivatives of the quotient, at places that are denser towards half a period, where p is
  /// least.
  double lost_digits() const {
    constexpr int kPlaces = 60;
    constexpr double kOfValue = 4 * std::numeric_limits<double>::epsilon();
    const double whole = std::isfinite(function_.period()) ? function_.period() : horizon();
    double size = std::abs(start_), largest = 0;
    for (int k = 1; k <= kPlaces; ++k) {
      const double aside = std::exp2(-k);
      for (const double share : {0.5 - aside / 2, k == kPlaces ? 0.5 : aside / 2}) {
        TwoDoubles t{share * whole, 0};
        const auto values = function_(t);
        if (!values) continue;
        const auto [p, p1] = *values;
        const double w = p - c_;
        const double above = -v_ * p1 + slope_ * w + bend_, below = 2 * w * w - last_;
        const double by_p = (slope_ * below - above * 4 * w) / (below * below);
        const double error =
            kOfValue * ((std::abs(p) + std::abs(c_)) * std::abs(by_p) + std::abs(p1 * v_ / below));
        size = std::max(size, std::abs(start_ + above / below));
        largest = std::max(largest, error);
      }
    }
    return size > 0 ? largest / size : 0;
  }

  static double part(const N& of, int of_whole) {
    return cln::double_approx(of / cln::cl_float(cln::cl_RA(of_whole), of));
  }
  // f = a0 y^4 + 4 a1 y^3 + 6 a2 y^2 + 4 a3 y + a4 around the point.
  static N coefficient(const Quartic& at, int k) {  // a_k
    constexpr int kFactors[5] = {24, 24, 12, 4, 1};
    return at.f[4 - k] / cln::cl_float(cln::cl_RA(kFactors[k]), at.f[0]);
  }
  static N g2(const Quartic& at) {
    const auto a = [&](int k) { return coefficient(at, k); };
    return a(0) * a(4) - times(4, a(1)) * a(3) + times(3, a(2)) * a(2);
  }
  static N g3(const Quartic& at) {
    const auto a = [&](int k) { return coefficient(at, k); };
    return a(0) * a(2) * a(4) + times(2, a(1)) * a(2) * a(3) - a(2) * a(2) * a(2) -
           a(0) * a(3) * a(3) - a(1) * a(1) * a(4);
  }

  Weierstrass function_;
  double start_, v_, c_, slope_, bend_, last_, momentum_;
  double lost_;  ///< see `lost_digits`
};

N value(const std::vector<N>& f, const N& x) {
  N sum = cln::cl_float(cln::cl_RA(0), x);
  for (std::size_t k = f.size(); k-- > 0;) sum = sum * x + f[k];
  return sum;
}

std::vector<N> derivative(const std::vector<N>& f) {
  std::vector<N> result;
  for (std::size_t k = 1; k < f.size(); ++k) result.push_back(times(static_cast<int>(k), f[k]));
  return result;
}

/// The places to one side of x at which f changes its sign, or touches zero, and those of its
/// derivatives: between two of them it is monotone. `side` is 1 or -1; all lie within `far`.
std::vector<N> zeros(const std::vector<N>& f, const N& x, const N& far, int side) {
  if (f.size() < 2) return {};
  std::vector<N> ends = zeros(derivative(f), x, far, side);
  ends.insert(ends.begin(), x);
  ends.push_back(x + times(side, far));
  std::vector<N> result;
  N size = cln::abs(f.back());
  for (const N& factor : f) size = size + cln::abs(factor);
  const N nothing = undecided_part(x) * size;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    N from = ends[i], to = ends[i + 1];
    if (i > 0 && cln::abs(value(f, from)) < nothing) result.push_back(from);
    const bool rises = cln::minusp(value(f, from));
    if (cln::minusp(value(f, to)) == rises) continue;
    for (int halved = 0; halved < 1100 && from != to; ++halved) {
      const N middle = (from + to) / cln::cl_float(cln::cl_RA(2), x);
      if (middle == from || middle == to) break;
      (cln::minusp(value(f, middle)) == rises ? from : to) = middle;
    }
    result.push_back(from);
  }
  return result;
}

/// Whether f, which is not negative at x, comes down to zero on that side.
bool comes_back(const std::vector<N>& f, const N& x, int side) {
  // All zeros are within 1 + max |f_k / f_n| of the origin (Cauchy).
  N bound = cln::cl_float(cln::cl_RA(1), x);
  std::size_t degree = f.size() - 1;
  while (degree > 0 && cln::zerop(f[degree])) --degree;
  if (degree == 0) return false;
  for (std::size_t k = 0; k < degree; ++k) bound = std::max(bound, N(cln::abs(f[k] / f[degree])));
  const std::vector<N> cut(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(degree) + 1);
  return !zeros(cut, x, bound + times(2, bound) + cln::abs(x), side).empty();
}

/// Whether the motion stays between two zeros of f = q'^2.
bool bounded(const std::vector<N>& f, const N& q, const N& v) {
  const N slope = value(derivative(f), q);
  if (cln::zerop(v)) return comes_back(f, q, cln::minusp(slope) ? -1 : 1);
  return comes_back(f, q, 1) && comes_back(f, q, -1);
}

}  // namespace

Recognised polynomial_force(const Motion& motion) {
  const std::string other = "the equations are not q' = a p, p' = a polynomial of degree 3 in q";
  if (motion.states() != 2 || motion.field[0].size() != 1) return {nullptr, other};
  const N a = motion.coefficient(0, {0, 0, 0, 1, 0, 0});
  if (cln::zerop(a)) return {nullptr, other};
  std::vector<N> force;
  std::size_t terms = 0;
  for (int k = 0; k <= 3; ++k) {
    force.push_back(motion.coefficient(1, {k, 0, 0, 0, 0, 0}));
    if (!cln::zerop(force.back())) ++terms;
  }
  if (terms != motion.field[1].size()) return {nullptr, other};
  const N &q = motion.initial[0], v = a * motion.initial[1];
  // q'' = a force, so q'^2 = f = v^2 + 2 a (F(q) - F(q(0))) with F' = force.
  std::vector<N> f{motion.zero()};
  for (int k = 0; k <= 3; ++k)
    f.push_back(times(2, a) * force[static_cast<std::size_t>(k)] / motion.number(k + 1));
  f[0] = v * v - value(f, q);
  Quartic at;
  std::vector<N> derived = f;
  for (N& of : at.f) {
    of = derived.empty() ? motion.zero() : value(derived, q);
    derived = derivative(derived);
  }
  at.f[0] = v * v;
  const bool rests = cln::zerop(v) && cln::zerop(at.f[1]);
  if (!rests && !bounded(f, q, v))
    return {nullptr, "the motion is not bounded: its closed form has poles"};
  if (rests) return at_rest(motion);
  auto form = std::make_shared<Biermann>(at, q, v, a);
  // Written so that what is no number is refused too.
  constexpr double kMostLost = 1e-12;
  if (!(form->lost() < kMostLost))
    return {nullptr, "it starts so near to a rest that its closed form has not all digits"};
  return {std::move(form), ""};
}

}  // namespace casimir::exact
