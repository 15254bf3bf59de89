#pragma once

#include <cln/rational.h>

#include <optional>
#include <string>

namespace casimir::obstruction {

/// Whether Lame's equation y'' = (n(n+1) wp + B) y, algebraic in z = wp: y'' + P'/(2P) y' + Q/P y =
/// 0 with a cubic P without double roots and a linear Q, may have a solvable identity component for
/// this n (Morales-Ruiz, Differential Galois Theory and Non-Integrability, 1999, 2.8.4): n is an
/// integer (Lame and Hermite), or n + 1/2 is one (Brioschi, Halphen and Crawford, for roots B of
/// Brioschi's determinant), or n + 1/2 is in Z/3, Z/4 or Z/5 (Baldassarri, for some B and P).
/// \param square  (n + 1/2)^2, the square of the difference of exponents at infinity
/// \return  the class; empty where it is in none
std::optional<std::string> lame_class(const cln::cl_RA& square);

/// The equation's cubic, if p = P'/(2P) and q P is linear for the denominator P of p; F is
/// RationalFunction or ParametricFunction.
template <class F>
bool is_lame(const F& p, const F& q);

}  // namespace casimir::obstruction
