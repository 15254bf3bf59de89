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

}  // namespace

RationalInterval ends_of(const ArbBall& ball) {
  if (arb_is_finite(ball.raw()) == 0) throw std::domain_error("the value is not finite");
  arf_t radius;
  arf_init(radius);
  arf_set_mag(radius, arb_radref(ball.raw()));
  const cln::cl_RA middle = rational(arb_midref(ball.raw())), by = rational(radius);
  arf_clear(radius);
  return {middle - by, middle + by};
}

}  // namespace casimir::validated
