#pragma once

#include <cln/float.h>
#include <cln/rational.h>

#include <array>
#include <optional>

namespace casimir::discrete {

/// The elementary symmetric functions of the eigenvalues of J w, of degree 1 and 2, for the
/// rotation w with w^T J - J w = m (as a matrix) that comes from the identity when m grows from 0.
struct RotationStart {
  cln::cl_F e1, e2;
};

/// With A = tr J^2 - |m|^2 and B = sum J_i^2 J_j^2 - |J m|^2, e1 solves
/// (e1^2 - A)^2/4 - 2 e1 det J = B, and e2 = (e1^2 - A)/2. At m = 0 the identity has e1 = tr J;
/// this root is followed along t m, 0 <= t <= 1.
/// \return  nothing where it meets another root on the way: then no rotation is near the identity
std::optional<RotationStart> rotation_near_identity(const std::array<cln::cl_RA, 3>& tensor,
                                                    const std::array<cln::cl_RA, 3>& m);

}  // namespace casimir::discrete
