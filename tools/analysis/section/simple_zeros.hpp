#pragma once

#include <ginac/ginac.h>

#include <vector>

namespace casimir {

/// A function with the same sign as the given one wherever neither is zero, in which factors stand
/// once that stand to an odd power there, and those to an even one are left out: it changes its
/// sign where the other does, and its zeros are simple, so that rounding moves them by rounding and
/// not by a root of it. The function itself where it has no such factors, or never changes its
/// sign. Powers, products and polynomials of few terms with rational coefficients are taken apart.
/// \param variables  what the function depends on.
GiNaC::ex with_simple_zeros(const GiNaC::ex& function, const std::vector<GiNaC::symbol>& variables);

}  // namespace casimir
