#pragma once

#include <ginac/ginac.h>

namespace casimir {

/// base^exponent by principal values. GiNaC makes x^(-1/2) of (1/x)^(1/2), which is right for x > 0
/// only; among complex numbers it is x^(1/2)/(x^2)^(1/2).
GiNaC::ex principal_power(const GiNaC::ex& base, const GiNaC::ex& exponent, bool complex_numbers);

/// Whether it is a constant that is made of numbers that are not real, as GiNaC's log(-3), or a
/// root of even order of a negative number. Only constants become complex by themselves.
bool is_complex_constant(const GiNaC::ex& value);

/// Whether it is a constant and no real number: one of those, or by its decimals, as acos(2). What
/// has none within the limit, see `decimal`, is taken for real.
bool is_no_real_constant(const GiNaC::ex& value, double bits);

}  // namespace casimir
