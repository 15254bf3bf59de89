#pragma once

#include <optional>

#include "symbolic/discrete/kahan.hpp"

namespace casimir {

/// The map of Moser and Veselov (Commun. Math. Phys. 139 (1991) 217) of a free rigid body on so(3),
/// H = (a1 m1^2 + a2 m2^2 + a3 m3^2)/2. With the moments of inertia 1/a_i = J_j + J_k and the
/// rotation w near the identity that solves w^T J - J w = step m (vectors as skew matrices), the
/// next m is w m. It keeps |m|^2 and H, and is symmetric, of order 2.
///
/// Rational formulas: Y = J w has Y Y^T = J^2 and Y^T - Y = M, so that Y^2 = J^2 - Y M; this in
/// Y^3 - e1 Y^2 + e2 Y - det J = 0 gives Y (J^2 + M^2 + e1 M + e2) = J^2 (M + e1) + det J. And
/// (l - Y)(l + Y^T) = l^2 + l M - J^2 gives e1^2 - 2 e2 = tr J^2 - |m|^2 and
/// e2^2 - 2 e1 det J = sum J_i^2 J_j^2 - |J m|^2: the two relations between m and the added
/// variables e1, e2, which are constant since what is on the right is. Which of the solutions w is
/// taken is what the start of e1, e2 says.
///
/// det(J^2 + M^2 + e1 M + e2) = (e1 e2 - det J)^2 + |(J^2 + e2) m|^2 where the relations hold. No
/// J_i has to be different from 0: the formulas have J in no denominator.
/// \param value  of the step; without it the step is a parameter
/// \throws ModelError  where the case is no free body, or no scene has a rotation near the identity;
///                     TooLarge
RationalMapText moser_veselov_map(const Model& flow, const std::optional<GiNaC::ex>& value);

}  // namespace casimir
