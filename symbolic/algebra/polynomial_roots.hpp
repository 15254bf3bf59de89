#pragma once

#include <cln/integer.h>

#include <utility>
#include <vector>

namespace casimir::search {

/// All complex roots of a polynomial without double roots, by Arb: real ones have an imaginary part
/// of exactly 0, and no others have.
/// \param coefficients  integers, from that of degree 0 on
/// \return  real and imaginary parts, in order
std::vector<std::pair<double, double>> complex_roots(const std::vector<cln::cl_I>& coefficients);

}  // namespace casimir::search
