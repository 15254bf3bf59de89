#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace casimir {

/// The value of an expression without symbols, to GiNaC::Digits digits. Empty where it has symbols,
/// or no value, or an inverse function of a number that is not real, or where a number on the way
/// would be larger than 2^bits or smaller than 2^-bits: GiNaC's own evalf throws errors of CLN
/// there, or computes pi to as many digits as the argument of a sine has.
/// \param bits  as of `Limits`
std::optional<GiNaC::numeric> decimal(const GiNaC::ex& value, double bits);

/// The same for a real number.
std::optional<GiNaC::numeric> real_decimal(const GiNaC::ex& value, double bits);

}  // namespace casimir
