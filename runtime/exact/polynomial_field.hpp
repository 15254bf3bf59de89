#pragma once

#include <cln/float.h>

#include <map>
#include <optional>
#include <vector>

#include "runtime/program.hpp"

namespace casimir {

/// Digits of the numbers that closed forms are worked out in, before they are rounded.
inline constexpr int kExactDigits = 300;

/// A polynomial in the states and in the sines and cosines of states: by the exponents, 3 for each
/// state (of itself, of its sine, of its cosine), its coefficients, none of which is zero.
using ExactPolynomial = std::map<std::vector<int>, cln::cl_F>;

/// The rates of a system as such polynomials; nothing where they are others, depend on the time or
/// on parameters at run time. Where coefficients cancel but for rounding, they are left: whoever
/// asks for a shape then finds a term too many.
std::optional<std::vector<ExactPolynomial>> polynomial_field(const Program& rhs);

}  // namespace casimir
