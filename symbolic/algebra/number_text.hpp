#pragma once

#include <cln/rational.h>
#include <ginac/ginac.h>

#include <string>

namespace casimir {

/// "-2/3": a rational number in the notation of case files.
std::string rational_text(const cln::cl_RA& value);

/// An expression as GiNaC writes it, which case files read back.
std::string expression_text(const GiNaC::ex& value);

/// Adds one term to a sum that is being written: " + 2*x", or "-x" where the sum is empty.
/// \param monomial  without its coefficient; empty for a constant
void append_term(std::string& sum, const cln::cl_RA& coefficient, const std::string& monomial);

/// "(a + b)/(c)": a bracket above where there is a sum, and always one below.
std::string quotient_text(const std::string& top, bool top_is_sum, const std::string& bottom);

}  // namespace casimir
