#pragma once

#include <cln/integer.h>
#include <cln/integer_io.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace casimir {

// Between doubles and exact numbers, subnormal doubles included, which CLN has not: it throws an
// exception at the one and makes 0 of the other.

/// What a finite double is, which is not what its shortest decimal says.
inline cln::cl_RA exact_number(double number) {
  constexpr int kBits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const cln::cl_I mantissa =
      static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), kBits));
  exponent -= kBits;
  return exponent < 0 ? mantissa / cln::cl_RA(cln::ash(1, -exponent))
                      : cln::cl_RA(cln::ash(mantissa, exponent));
}

/// The double nearest to a number: an infinity beyond the largest one.
inline double nearest_double(const cln::cl_RA& number) {
  const double nearest = cln::double_approx(number);
  if (std::abs(nearest) > 2 * std::numeric_limits<double>::min() || cln::zerop(number))
    return nearest;
  constexpr int kLeast =
      std::numeric_limits<double>::digits - std::numeric_limits<double>::min_exponent;
  return std::ldexp(cln::double_approx(cln::round1(number * cln::ash(1, kLeast))), -kLeast);
}

}  // namespace casimir
