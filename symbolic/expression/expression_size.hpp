#pragma once

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {

/// Of the longer of numerator and denominator; 64 for a number that is not rational.
double bit_length(const GiNaC::numeric& number);

/// The bounds of a finished expression, as reading its text would have given them.
Quantity measured(const GiNaC::ex& value);

/// At most so many terms has the expression when it is expanded, those of denominators and
/// radicands counted, which are expanded as well.
double most_terms(const GiNaC::ex& expression);

/// Expanded, if that makes no more than so many terms; else as it is.
GiNaC::ex expanded_within(const GiNaC::ex& expression, double terms);

/// Whether GiNaC's rational functions take all exponents as they are: x^(1/q), with q common to all
/// of them, becomes a variable, whose degree is counted in 32 bits.
bool is_fit_for_normal(const GiNaC::ex& expression);

/// `expression`.
/// \throws TooLarge  if it is not fit
const GiNaC::ex& fit_for_normal(const GiNaC::ex& expression);

/// GiNaC's quotient of polynomials, of what is fit for it.
/// \throws TooLarge
inline GiNaC::ex normal_form(const GiNaC::ex& expression) {
  return fit_for_normal(expression).normal();
}

/// A power, of which GiNaC computes those of numbers at once, as 2^(10^12).
/// \throws TooLarge  where such a number would exceed the limit `bits`.
GiNaC::ex checked_power(const GiNaC::ex& base, const GiNaC::ex& exponent, const Limits& limits);

/// Of atan2(0, 0), which GiNaC takes for 0.
class NoAngle : public GiNaC::pole_error {
 public:
  NoAngle() : GiNaC::pole_error("atan2(0, 0) has no value", 0) {}
};

/// `expression` with values put in, its powers checked.
/// \throws TooLarge
/// \throws NoAngle
GiNaC::ex substituted(const GiNaC::ex& expression, const GiNaC::exmap& values,
                      const Limits& limits);

}  // namespace casimir
