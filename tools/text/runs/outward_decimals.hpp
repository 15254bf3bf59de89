#pragma once

#include <cln/rational.h>

#include <string>
#include <utility>

#include "runtime/validated_run.hpp"

namespace casimir::tools {

/// The ends of an interval as decimals, rounded outwards: as many digits as tell its width to about
/// three, but no more than some beyond `least`.
std::pair<std::string, std::string> decimal_ends(const RationalInterval& interval, int least = 17);

/// A number that is not negative as a decimal of three digits, not below it.
std::string decimal_above(const cln::cl_RA& value);

/// A decimal of six places that is not above a number.
std::string decimal_below(const cln::cl_RA& value);

/// The power of ten that is not below a number, which is not negative: "1e-12".
std::string power_of_ten_above(const cln::cl_RA& value);

/// A number with so many digits, not further from zero than it is.
std::string decimal_towards_zero(const cln::cl_RA& value, int digits);

/// The middle of an interval with so many digits, rounded to the nearest.
std::string middle_text(const RationalInterval& x, int digits);

}  // namespace casimir::tools
