#include "runtime/validated/rational_ends.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <stdexcept>

namespace casimir::validated {
namespace {

cln::cl_RA rational(const arf_t number) {
  fmpz_t mantissa, exponent;
  fmpz_init(mantissa);
  fmpz_init(exponent);
  arf_get_fmpz_2exp(mantissa, exponent, number);
  char* const digits = fmpz_get_str(nullptr, 10, mantissa);
  const cln::cl_I whole(static_cast<const char*>(digits));
  const long shift = fmpz_get_si(exponent);
  flint_free(digits);
  fmpz_clear(mantissa);
  fmpz_clear(exponent);
  if (shift >= 0) return cln::ash(whole, shift);
  return whole / cln::ash(cln::cl_I(1), -shift);
}

/// The least size of an end: a number such as exp(-10^8) has as many digits below its point.
constexpr slong kLeastExponent = -20000;

/// Around a ball that is smaller than 2^kLeastExponent, which has not one point alone.
RationalInterval around_tiny(const ArbBall& ball) {
  const cln::cl_RA least = cln::expt(cln::cl_RA(2), cln::cl_I(kLeastExponent));
  return {arb_is_nonnegative(ball.raw()) != 0 ? cln::cl_RA(0) : -least,
          arb_is_nonpositive(ball.raw()) != 0 ? cln::cl_RA(0) : least};
}

}  // namespace

RationalInterval ends_of(const ArbBall& ball) {
  if (arb_is_finite(ball.raw()) == 0) throw std::domain_error("the value is not finite");
  if (arb_is_exact(ball.raw()) == 0 &&
      mag_cmp_2exp_si(arb_radref(ball.raw()), kLeastExponent) < 0 &&
      arf_cmpabs_2exp_si(arb_midref(ball.raw()), kLeastExponent) < 0)
    return around_tiny(ball);
  arf_t radius;
  arf_init(radius);
  arf_set_mag(radius, arb_radref(ball.raw()));
  if (arf_is_zero(radius) == 0 && arf_cmp_2exp_si(radius, kLeastExponent) < 0)
    arf_set_si_2exp_si(radius, 1, kLeastExponent);
  const cln::cl_RA middle = rational(arb_midref(ball.raw())), by = rational(radius);
  arf_clear(radius);
  return {middle - by, middle + by};
}

}  // namespace casimir::validated
