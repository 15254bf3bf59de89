#include "runtime/validated/mid_rad.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "runtime/program/arb_function.hpp"
#include "runtime/validated/arb_ball.hpp"
#include "runtime/validated/wide_registers.hpp"

namespace casimir::validated {

/// With q = fl(m_a / m_b), x / y - q = (m_a/m_b - q) m_b/y + (x - m_a)/y + (m_a/m_b) (m_b - y)/y,
/// where |y| >= |m_b| - rad(b) and |m_a/m_b| <= (1 + u) |q| + 2^-1075.
MidRad operator/(const MidRad& a, const MidRad& b) {
  if (!is_usable(b) || contains_zero(b)) throw std::domain_error("division by zero");
  if (b.rad == 0 && is_power_of_two(b.mid)) return a * MidRad(1 / b.mid);
  const double quotient = a.mid / b.mid, size = std::abs(quotient), divisor = std::abs(b.mid);
  if (b.rad == 0) return {quotient, upwards(a.rad / divisor + kUnit * size)};
  const double lost = (kUnit * size + kUnderflow) * divisor + (size + kUnderflow) * b.rad;
  return {quotient, upwards((lost + a.rad + kUnderflow) / (divisor - b.rad))};
}

bool intersect(MidRad& a, const MidRad& b) {
  if (!is_usable(b)) return true;
  // The ends, outwards.
  const auto end = [](double mid, double by) {
    const double x = mid + by;
    return x + std::copysign(kUnit * std::abs(x) * 4 + kUnderflow, by);
  };
  const double low = std::max(end(a.mid, -a.rad), end(b.mid, -b.rad));
  const double high = std::min(end(a.mid, a.rad), end(b.mid, b.rad));
  if (low > high) return false;
  const double mid = 0.5 * low + 0.5 * high;
  const double rad = upwards(std::max(high - mid, mid - low));
  if (rad < a.rad) a = {mid, rad};
  return true;
}

bool contains(const MidRad& b, const MidRad& a) {
  return is_usable(a) && is_usable(b) && upwards(std::abs(a.mid - b.mid) + a.rad) <= b.rad;
}

namespace {

/// Enough that Arb's own error is far below the rounding to double.
constexpr slong kBits = 80;

/// An Arb function on all of a ball.
MidRad applied_to(ArbFunction function, const MidRad& a) {
  if (!is_usable(a)) throw std::domain_error("the numbers have become too large");
  ArbBall ball(a);
  function(ball.raw(), ball.raw(), kBits);
  return outwards(ball);
}

}  // namespace

}  // namespace casimir::validated

namespace casimir {

using validated::applied_to;
using validated::ArbBall;
using validated::contains_zero;
using validated::is_exact;
using validated::is_usable;
using validated::kUnderflow;
using validated::kUnit;
using validated::MidRad;
using validated::upwards;
using MidRadArithmetic = Arithmetic<MidRad>;

MidRad MidRadArithmetic::from(const cln::cl_RA& value) {
  if (cln::zerop(value)) return MidRad(0);
  const validated::BallPrecision precision(validated::kBits);
  return validated::outwards(ArbBall(value));
}

MidRad MidRadArithmetic::pi() {
  ArbBall ball;
  arb_const_pi(ball.raw(), validated::kBits);
  return validated::outwards(ball);
}

MidRad MidRadArithmetic::sqrt(const N& a) {
  if (is_exact(a) && a.mid == 0) return a;
  if (!(a.mid > 0) || contains_zero(a))
    throw std::domain_error("square root of a number that may be negative");
  return applied_to(arb_sqrt, a);
}

MidRad MidRadArithmetic::power(const N& a, const N& e) {
  if (!(a.mid > 0) || contains_zero(a))
    throw std::domain_error("broken power of a number that may not be positive");
  if (!is_usable(a) || !is_usable(e)) throw std::domain_error("the numbers have become too large");
  ArbBall base(a);
  const ArbBall exponent(e);
  arb_pow(base.raw(), base.raw(), exponent.raw(), validated::kBits);
  return validated::outwards(base);
}

MidRad MidRadArithmetic::function(Op op, const N& a) { return applied_to(arb_function(op), a); }

MidRad MidRadArithmetic::log(const N& a) {
  if (!(a.mid > 0) || contains_zero(a))
    throw std::domain_error("logarithm of a number that may not be positive");
  return applied_to(arb_log, a);
}

namespace {
/// Arcs have no derivative at the ends of [-1, 1].
void check_arc(const MidRad& a) {
  const bool end = is_exact(a) && std::abs(a.mid) == 1;
  if (!end && !(upwards(std::abs(a.mid) + a.rad) < 1))
    throw std::domain_error("arc of a number that may not be between -1 and 1");
}
}  // namespace

MidRad MidRadArithmetic::asin(const N& a) {
  check_arc(a);
  return applied_to(arb_asin, a);
}

MidRad MidRadArithmetic::acos(const N& a) {
  check_arc(a);
  return applied_to(arb_acos, a);
}

MidRad MidRadArithmetic::atan2(const N& y, const N& x) {
  const bool exact = is_exact(y) && is_exact(x) && (y.mid != 0 || x.mid != 0);
  const bool off_the_cut = !contains_zero(y) || (x.mid > 0 && !contains_zero(x));
  if (!exact && !off_the_cut) throw std::domain_error("an angle that may be on its cut");
  if (!is_usable(y) || !is_usable(x)) throw std::domain_error("the numbers have become too large");
  ArbBall angle;
  const ArbBall above(y), right(x);
  arb_atan2(angle.raw(), above.raw(), right.raw(), validated::kBits);
  return validated::outwards(angle);
}

int MidRadArithmetic::sign(const N& a) {
  if (!is_usable(a) || contains_zero(a)) throw std::domain_error("a sign that is not certain");
  return a.mid < 0 ? -1 : 1;
}

namespace {

/// sum over j = from..to of w_j u_j v_{k-j}, with w_j = j or 1.
///
/// The terms are added for falling j to four sums in turn, and these in pairs: so the term j passes
/// at most (j - from)/4 + 1 additions to its sum, 2 further ones, and 2 products, that is j + 5
/// roundings or fewer for every j >= from >= 0; the midpoint is thus off by at most
/// gamma_{j+5} |w_j u_j v_{k-j}| for each term, gamma_n = n u / (1 - n u) <= (n + 1) u (Higham,
/// Accuracy and Stability of Numerical Algorithms, 2002, Sec. 3.1, whatever the order and where
/// products are fused). Together with the radii,
///   |x y - m_u m_v| <= |m_u| rad(v) + rad(u) (|m_v| + rad(v)),
/// and (j + 6) u |m_u| beside rad(u). kUnderflow in the place of |m_u| keeps that from
/// underflowing. The radius passes at most k/4 + 12 roundings, which `upwards` covers for k below
/// 1900; products that underflow lose 2^-1075 each, which it covers too.
template <bool kWeighted>
CASIMIR_INLINE_ALWAYS MidRad sum_of_products(const MidRad* a, const MidRad* b, int from, int to) {
  using validated::LanesOf;
  using Four = LanesOf<4>;
  static_assert(sizeof(MidRad) == 2 * sizeof(double));
  Four mid{}, rad{};
  int j = to;
  for (; j - 3 >= from; j -= 4) {
    // a_{j-3}, .., a_j and b_{-j+3}, .., b_{-j}: the latter from behind.
    const double* const x = &a[j - 3].mid;
    const double* const y = &b[-j].mid;
    Four low, high;
    std::memcpy(&low, x, sizeof low);
    std::memcpy(&high, x + 4, sizeof high);
    Four m = __builtin_shufflevector(low, high, 0, 2, 4, 6);
    Four r = __builtin_shufflevector(low, high, 1, 3, 5, 7);
    std::memcpy(&low, y, sizeof low);
    std::memcpy(&high, y + 4, sizeof high);
    const Four other_mid = __builtin_shufflevector(low, high, 6, 4, 2, 0);
    const Four other_rad = __builtin_shufflevector(low, high, 7, 5, 3, 1);
    const double at = j;
    const Four index = {at - 3, at - 2, at - 1, at};
    if (kWeighted) {
      m *= index;
      r *= index;
    }
    const Four size = (m < 0 ? -m : m) + kUnderflow;
    const Four other = (other_mid < 0 ? -other_mid : other_mid) + other_rad;
    mid += m * other_mid;
    rad += size * other_rad + (r + kUnit * (index + 6.) * size) * other;
  }
  for (int lane = 0; j >= from; --j, ++lane) {
    const MidRad &x = a[j], &y = b[-j];
    const double m = kWeighted ? j * x.mid : x.mid, r = kWeighted ? j * x.rad : x.rad;
    const double size = std::abs(m) + kUnderflow, other = std::abs(y.mid) + y.rad;
    mid[lane] += m * y.mid;
    rad[lane] += size * y.rad + (r + kUnit * (j + 6) * size) * other;
  }
  return {(mid[0] + mid[1]) + (mid[2] + mid[3]), upwards((rad[0] + rad[1]) + (rad[2] + rad[3]))};
}

CASIMIR_FOR_WIDE_REGISTERS
MidRad plain_sum(const MidRad* a, const MidRad* b, int from, int to) {
  return sum_of_products<false>(a, b, from, to);
}
CASIMIR_FOR_WIDE_REGISTERS
MidRad weighted_sum(const MidRad* a, const MidRad* b, int from, int to) {
  return sum_of_products<true>(a, b, from, to);
}

}  // namespace

MidRad MidRadArithmetic::convolution(const Series& u, const Series& v, int k, int from, int to) {
  return plain_sum(u.data(), v.data() + k, from, to);
}

MidRad MidRadArithmetic::weighted(const Series& u, const Series& v, int k, int from, int to) {
  return weighted_sum(u.data(), v.data() + k, from, to);
}

}  // namespace casimir
