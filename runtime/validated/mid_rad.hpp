#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/program/number.hpp"

namespace casimir::validated {

// Midpoint-radius arithmetic in double precision, rounded to nearest throughout.
//
// What is proved. Let u = 2^-53, and let fl be IEEE rounding to nearest of doubles. Then
//   (1) |fl(x) - x| <= u |fl(x)| + 2^-1075 for every real x below the overflow threshold: half a
//       unit in the last place of a normal number y is at most u |y|, and half of the smallest
//       subnormal number is 2^-1075. Sums of doubles do not underflow: they lack the second term.
//   (2) A formula of sums, products and quotients of numbers that are not negative (and of at most
//       one difference of two doubles), in which every operand passes at most K roundings, comes
//       out at least (1 - u)^K times its value, less 2^-1075 for each product or quotient that
//       underflows. With K <= 500, (1 - u)^K (1 + 2^-44) >= 1, and 500 times 2^-1075 is below
//       2^-960: so `upwards` of what is computed is at least the value, if no formula multiplies a
//       product that may have underflowed by a number above 1, or divides it. None below does:
//       where one would, kUnderflow is added first.
//   (3) Midpoints are computed as any rounding to nearest computes them; the radius has u |m| for
//       the last rounding, and sums have what `Arithmetic<MidRad>::convolution` says.
// A compiler may fuse a product with a sum (which rounds once where (1) counts twice), but must not
// rearrange sums, assume that there are no NaN, or flush subnormal numbers to zero: none of
// -ffast-math and its parts. Every intermediate number is a double (the assertion below).
//
// Where a number overflows, the midpoint or the radius of the result is infinite or a NaN, which
// sums and products hand on. Quotients and functions refuse what is not usable, and so does
// everything that decides: see `is_usable`, which a NaN fails.

#ifdef __FAST_MATH__
#error "balls of doubles are false with -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "doubles have to be rounded to double");

inline constexpr double kUnit = 0x1p-53;         ///< u, the unit of rounding
inline constexpr double kUpwards = 1 + 0x1p-44;  ///< covers 500 roundings
inline constexpr double kUnderflow = 0x1p-960;   ///< covers what underflows
inline constexpr double kLargest = 0x1p+900;     ///< of a ball that is a statement

/// A real number in [mid - rad, mid + rad].
struct MidRad {
  double mid = 0;
  double rad = 0;

  MidRad() = default;
  MidRad(double middle, double radius) : mid(middle), rad(radius) {}
  /// The double itself.
  explicit MidRad(double exact) : mid(exact) {}
};

/// At least what a formula of at most 480 roundings stands for, see (2).
inline double upwards(double computed) { return computed * kUpwards + kUnderflow; }

inline bool is_exact(const MidRad& a) { return a.rad == 0; }

/// Whether a number is +-2^k, k being such that products and quotients with numbers of moderate
/// size are exact.
inline bool is_power_of_two(double x) {
  constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;
  const double size = std::abs(x);
  return (std::bit_cast<std::uint64_t>(x) & kFraction) == 0 && size >= 0x1p-60 && size <= 0x1p+60;
}

inline MidRad operator-(const MidRad& a) { return {-a.mid, a.rad}; }

/// |m - (x + y)| <= u |m| + rad(a) + rad(b): by (1), where a sum never underflows inexactly.
[[gnu::always_inline]] inline MidRad operator+(const MidRad& a, const MidRad& b) {
  if (a.mid == 0 && a.rad == 0) return b;
  if (b.mid == 0 && b.rad == 0) return a;
  const double mid = a.mid + b.mid;
  return {mid, upwards(a.rad + b.rad + kUnit * std::abs(mid))};
}

inline MidRad operator-(const MidRad& a, const MidRad& b) { return a + (-b); }

/// x y - m_a m_b = m_a (y - m_b) + (x - m_a) y, and |y| <= |m_b| + rad(b).
inline MidRad operator*(const MidRad& a, const MidRad& b) {
  // A factor that is a power of two, as 1 or 1/2, rounds nothing.
  if (b.rad == 0 && is_power_of_two(b.mid)) {
    const bool exact = a.rad == 0 && (a.mid == 0 || std::abs(a.mid) > kUnderflow);
    return {a.mid * b.mid, exact ? 0 : upwards(a.rad * std::abs(b.mid))};
  }
  if (a.rad == 0 && is_power_of_two(a.mid)) return b * a;
  const double mid = a.mid * b.mid;
  return {mid, upwards(std::abs(a.mid) * b.rad + a.rad * (std::abs(b.mid) + b.rad) +
                       kUnit * std::abs(mid))};
}

inline bool contains_zero(const MidRad& a) { return !(std::abs(a.mid) > a.rad); }

/// Whether the ball says anything: see above. A NaN is not usable.
inline bool is_usable(const MidRad& a) {
  return std::abs(a.mid) <= kLargest && a.rad >= 0 && a.rad <= kLargest;
}

/// The quotient. \throws std::domain_error  where b contains zero.
MidRad operator/(const MidRad& a, const MidRad& b);

// What the rest of this folder asks of a ball, whatever its digits.

/// 2^exponent, exactly.
template <class Ball>
Ball power_of_two(int exponent);
template <>
inline MidRad power_of_two<MidRad>(int exponent) {
  return MidRad(std::ldexp(1., exponent));
}
/// The middle of the ball, as a number without doubt.
inline MidRad middle_of(const MidRad& a) { return MidRad(a.mid); }
/// The middle as a double, to orient oneself by.
inline double approximate(const MidRad& a) { return a.mid; }
/// The ball itself: it is one of doubles.
inline MidRad outwards(const MidRad& a) { return a; }
/// At least |x| for all x in the ball.
inline double magnitude(const MidRad& a) { return upwards(std::abs(a.mid) + a.rad); }
/// log2 of at least |x| for all x in the ball; -infinity for zero.
inline double log2_magnitude(const MidRad& a) { return std::log2(std::abs(a.mid) + a.rad); }
/// At least the radius.
inline double radius_of(const MidRad& a) { return a.rad; }
/// The ball around zero of the radius of a.
inline MidRad deviation_of(const MidRad& a) { return {0, a.rad}; }
/// The smallest ball around zero with everything in a.
inline MidRad symmetric(const MidRad& a) { return {0, magnitude(a)}; }
/// What lies between zero and any number of a ball that is not negative.
inline MidRad from_zero_to(const MidRad& a) {
  const double half = upwards(a.mid + a.rad) * 0.5;
  return {half, upwards(half)};
}
/// x + y where the middle stays that of x.
inline MidRad widened(const MidRad& a, const MidRad& by) {
  return {a.mid, upwards(a.rad + std::abs(by.mid) + by.rad)};
}
/// What is in both; false where that is empty, and nothing is changed.
bool intersect(MidRad& a, const MidRad& b);
/// Whether all of a is in b.
bool contains(const MidRad& b, const MidRad& a);

}  // namespace casimir::validated

namespace casimir {

/// The elementary functions of balls: Arb's, converted outwards. All refuse by std::domain_error
/// where a function is not analytic on all of the ball, but for exact arguments, of which constants
/// are made.
template <>
struct Arithmetic<validated::MidRad> {
  using N = validated::MidRad;
  using Series = std::vector<N>;

  static N from(const cln::cl_RA& value);
  static N pi();
  static N divide(const N& a, const N& b) { return a / b; }
  /// a / k for k > 0: the rounded quotient m of the middle is off by at most u |m| + 2^-1075, of
  /// which `upwards` covers the last, and the radius is divided.
  static N over(const N& a, int k) {
    if ((k & (k - 1)) == 0) return a * N(1. / k);
    const double divisor = k, quotient = a.mid / divisor;
    return {quotient, validated::upwards(a.rad / divisor + validated::kUnit * std::abs(quotient))};
  }
  static N sqrt(const N& a);
  static N power(const N& a, const N& e);
  static N function(Op op, const N& a);
  static N log(const N& a);
  static N asin(const N& a);
  static N acos(const N& a);
  static N atan2(const N& y, const N& x);
  /// \throws std::domain_error  unless it is certain, and not zero.
  static int sign(const N& a);

  /// sum over j = from..to of u_j v_{k-j}
  static N convolution(const Series& u, const Series& v, int k, int from, int to);
  /// sum over j = from..to of j u_j v_{k-j}
  static N weighted(const Series& u, const Series& v, int k, int from, int to);
  static void begin_order(int) {}
};

}  // namespace casimir
