#pragma once

#include <string>
#include <vector>

#include "symbolic/search/darboux.hpp"

namespace casimir::search {

/// What the Darboux polynomials F_i with cofactors K_i of a motion X give together.
///
/// Theorem (Darboux): where no F_i is zero, d(log|F_i|)/dt = K_i. So if
/// X(g) + sum_i e_i K_i + s + m div(X) = 0 with constants e_i, s, m and a polynomial g, then
/// exp(g) * product of |F_i|^e_i * exp(s*t) is constant where m = 0, and with m = 1, s = 0 it is
/// the density of an invariant measure. The equation is linear in the constants and g. It is
/// checked exactly, as the claim that g + sum e_i w_i + s t + m v is an integral of the system with
/// the further variables dw_i/dt = K_i, dv/dt = div(X); and that each F_i is one is proved before.
/// \param degree  highest, of g
/// \param all_integrals  set to whether it is proved that there are no other integrals of that kind
/// \return  all for exponents that do not depend on the state, less those that follow from others
///     and the polynomial integrals
std::vector<DarbouxCombination> combine(const Model& model,
                                        const std::vector<DarbouxPolynomial>& found, int degree,
                                        const Watch& watch, bool* all_integrals = nullptr);

}  // namespace casimir::search
