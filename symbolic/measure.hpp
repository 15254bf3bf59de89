#pragma once

#include "symbolic/expression.hpp"

namespace casimir {

/// The bounds of a finished expression, as reading its text would have given them.
Quantity measured(const GiNaC::ex& value);

/// At most so many terms has the expression when it is expanded, those of denominators and
/// radicands counted, which are expanded as well.
double most_terms(const GiNaC::ex& expression);

/// Expanded, if that makes no more than so many terms; else as it is.
GiNaC::ex expanded_within(const GiNaC::ex& expression, double terms);

/// `expression` with values put in. GiNaC computes a power of a number at once, as 2^r at r =
/// 10^12. \throws TooLarge  where such an exponent exceeds the limit `bits`.
GiNaC::ex substituted(const GiNaC::ex& expression, const GiNaC::exmap& values);

}  // namespace casimir
