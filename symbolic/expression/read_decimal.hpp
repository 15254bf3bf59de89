#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>

namespace casimir {

/// A number such as 12, .5 or 1.25e-3, in decimals.
struct Decimal {
  std::string digits;   ///< without the point
  long exponent = 0;    ///< of the power of ten by which the digits are multiplied
  std::size_t end = 0;  ///< the place behind it
  double bits = 0;      ///< that the exact value has at most
  std::string problem;  ///< why it is no number; else empty

  /// The exact value, not to be asked for before `bits` was compared with the limit.
  GiNaC::numeric value() const;
};

/// Reads the number that starts at `at` with a digit or a point.
Decimal read_decimal(std::string_view text, std::size_t at);

}  // namespace casimir
