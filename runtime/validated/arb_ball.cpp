#include "runtime/validated/arb_ball.hpp"

#include <cln/integer_io.h>

#include <limits>
#include <sstream>
#include <stdexcept>

#include "runtime/program/arb_function.hpp"

namespace casimir::validated {

thread_local slong ArbBall::bits = 128;

namespace {

/// A rational number of FLINT, with the value of one of CLN.
struct Fraction {
  explicit Fraction(const cln::cl_RA& exact) {
    fmpq_init(value);
    std::ostringstream numerator, denominator;
    cln::fprinthexadecimal(numerator, cln::abs(cln::numerator(exact)));
    cln::fprinthexadecimal(denominator, cln::denominator(exact));
    fmpz_set_str(fmpq_numref(value), numerator.str().c_str(), 16);
    fmpz_set_str(fmpq_denref(value), denominator.str().c_str(), 16);
    if (cln::minusp(exact)) fmpq_neg(value, value);
  }
  ~Fraction() { fmpq_clear(value); }
  Fraction(const Fraction&) = delete;
  Fraction& operator=(const Fraction&) = delete;
  fmpq_t value;
};

/// A number of Arb's as a double that is not below it.
double double_above(const mag_t size) {
  arf_t exact;
  arf_init(exact);
  arf_set_mag(exact, size);
  const double result = arf_get_d(exact, ARF_RND_UP);
  arf_clear(exact);
  return result;
}

template <class Function>
ArbBall applied_to(Function function, const ArbBall& a) {
  ArbBall result;
  function(result.raw(), a.raw(), ArbBall::precision());
  if (arb_is_finite(result.raw()) == 0) throw std::domain_error("the value is not finite");
  return result;
}

}  // namespace

ArbBall::ArbBall(const MidRad& ball) : ArbBall() {
  arb_set_d(value_, ball.mid);
  mag_set_d(arb_radref(value_), ball.rad);  // upwards
}

ArbBall::ArbBall(const cln::cl_RA& value) : ArbBall() {
  Fraction exact(value);
  arb_set_fmpq(value_, exact.value, bits);
}

ArbBall operator/(const ArbBall& a, const ArbBall& b) {
  if (!is_usable(b) || contains_zero(b)) throw std::domain_error("division by zero");
  return ArbBall::with(arb_div, a, b);
}

bool is_exact(const ArbBall& a) { return arb_is_exact(a.raw()) != 0; }
bool contains_zero(const ArbBall& a) { return arb_contains_zero(a.raw()) != 0; }
bool is_usable(const ArbBall& a) { return arb_is_finite(a.raw()) != 0; }

ArbBall middle_of(const ArbBall& a) {
  ArbBall result;
  arb_get_mid_arb(result.raw(), a.raw());
  return result;
}

double approximate(const ArbBall& a) { return arf_get_d(arb_midref(a.raw()), ARF_RND_NEAR); }

double magnitude(const ArbBall& a) {
  mag_t size;
  mag_init(size);
  arb_get_mag(size, a.raw());
  const double result = double_above(size);
  mag_clear(size);
  return result;
}

double log2_magnitude(const ArbBall& a) {
  if (arb_is_zero(a.raw()) != 0) return -std::numeric_limits<double>::infinity();
  mag_t size;
  mag_init(size);
  arb_get_mag(size, a.raw());
  const double result = mag_get_d_log2_approx(size);
  mag_clear(size);
  return result;
}

double radius_of(const ArbBall& a) { return double_above(arb_radref(a.raw())); }

ArbBall deviation_of(const ArbBall& a) {
  ArbBall result;
  mag_set(arb_radref(result.raw()), arb_radref(a.raw()));
  return result;
}

ArbBall symmetric(const ArbBall& a) {
  ArbBall result;
  arb_get_mag(arb_radref(result.raw()), a.raw());
  return result;
}

ArbBall from_zero_to(const ArbBall& a) {
  // a times [1/2 - 1/2, 1/2 + 1/2]
  ArbBall share;
  arb_set_d(share.raw(), 0.5);
  mag_set_d(arb_radref(share.raw()), 0.5);
  return a * share;
}

ArbBall widened(const ArbBall& a, const ArbBall& by) {
  ArbBall result = a;
  mag_t size;
  mag_init(size);
  arb_get_mag(size, by.raw());
  mag_add(arb_radref(result.raw()), arb_radref(result.raw()), size);
  mag_clear(size);
  return result;
}

bool intersect(ArbBall& a, const ArbBall& b) {
  if (!is_usable(b)) return true;
  ArbBall both;
  if (arb_intersection(both.raw(), a.raw(), b.raw(), ArbBall::precision()) == 0) return false;
  if (mag_cmp(arb_radref(both.raw()), arb_radref(a.raw())) < 0) a = both;
  return true;
}

bool contains(const ArbBall& b, const ArbBall& a) { return arb_contains(b.raw(), a.raw()) != 0; }

MidRad outwards(const ArbBall& ball) {
  if (arb_is_finite(ball.raw()) == 0) throw std::domain_error("the value is not finite");
  const double middle = arf_get_d(arb_midref(ball.raw()), ARF_RND_NEAR);
  if (!(std::abs(middle) <= kLargest)) throw std::domain_error("the numbers have become too large");
  arf_t rest;
  mag_t radius;
  arf_init(rest);
  mag_init(radius);
  arf_set_d(rest, middle);
  arf_sub(rest, arb_midref(ball.raw()), rest, ARF_PREC_EXACT, ARF_RND_DOWN);
  arf_get_mag(radius, rest);
  mag_add(radius, radius, arb_radref(ball.raw()));
  const MidRad result(middle, double_above(radius));
  arf_clear(rest);
  mag_clear(radius);
  return result;
}

}  // namespace casimir::validated

namespace casimir {

using validated::ArbBall;
using ArbArithmetic = Arithmetic<ArbBall>;

namespace {

bool is_zero(const ArbBall& a) { return arb_is_zero(a.raw()) != 0; }
void check_positive(const ArbBall& a, const char* what) {
  if (arb_is_positive(a.raw()) == 0) throw std::domain_error(what);
}
/// Arcs have no derivative at the ends of [-1, 1], which constants may be at.
void check_arc(const ArbBall& a) {
  ArbBall one(1.), size;
  arb_abs(size.raw(), a.raw());
  if (arb_eq(size.raw(), one.raw()) == 0 && arb_lt(size.raw(), one.raw()) == 0)
    throw std::domain_error("arc of a number that may not be between -1 and 1");
}

}  // namespace

ArbBall ArbArithmetic::pi() {
  ArbBall result;
  arb_const_pi(result.raw(), ArbBall::precision());
  return result;
}

ArbBall ArbArithmetic::sqrt(const N& a) {
  if (is_zero(a)) return a;
  check_positive(a, "square root of a number that may be negative");
  return validated::applied_to(arb_sqrt, a);
}

ArbBall ArbArithmetic::power(const N& a, const N& e) {
  check_positive(a, "broken power of a number that may not be positive");
  ArbBall result;
  arb_pow(result.raw(), a.raw(), e.raw(), ArbBall::precision());
  if (!validated::is_usable(result)) throw std::domain_error("the value is not finite");
  return result;
}

ArbBall ArbArithmetic::function(Op op, const N& a) {
  return validated::applied_to(arb_function(op), a);
}

ArbBall ArbArithmetic::log(const N& a) {
  check_positive(a, "logarithm of a number that may not be positive");
  return validated::applied_to(arb_log, a);
}

ArbBall ArbArithmetic::asin(const N& a) {
  check_arc(a);
  return validated::applied_to(arb_asin, a);
}

ArbBall ArbArithmetic::acos(const N& a) {
  check_arc(a);
  return validated::applied_to(arb_acos, a);
}

ArbBall ArbArithmetic::atan2(const N& y, const N& x) {
  const bool exact =
      validated::is_exact(y) && validated::is_exact(x) && !(is_zero(y) && is_zero(x));
  if (!exact && validated::contains_zero(y) && arb_is_positive(x.raw()) == 0)
    throw std::domain_error("an angle that may be on its cut");
  ArbBall result;
  arb_atan2(result.raw(), y.raw(), x.raw(), ArbBall::precision());
  return result;
}

int ArbArithmetic::sign(const N& a) {
  if (arb_contains_zero(a.raw()) != 0) throw std::domain_error("a sign that is not certain");
  return arb_is_negative(a.raw()) != 0 ? -1 : 1;
}

ArbBall ArbArithmetic::convolution(const Series& u, const Series& v, int k, int from, int to) {
  ArbBall result;
  if (to < from) return result;
  const auto first = static_cast<std::size_t>(from), other = static_cast<std::size_t>(k - from);
  arb_dot(result.raw(), nullptr, 0, u[first].raw(), 1, v[other].raw(), -1, to - from + 1,
          ArbBall::precision());
  return result;
}

ArbBall ArbArithmetic::weighted(const Series& u, const Series& v, int k, int from, int to) {
  ArbBall result, part;
  for (int j = from; j <= to; ++j) {
    arb_mul_si(part.raw(), u[static_cast<std::size_t>(j)].raw(), j, ArbBall::precision());
    arb_addmul(result.raw(), part.raw(), v[static_cast<std::size_t>(k - j)].raw(),
               ArbBall::precision());
  }
  return result;
}

}  // namespace casimir
