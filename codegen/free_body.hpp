#pragma once

#include "codegen/scene_hamiltonian.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// What the map of Moser and Veselov asks of a free rigid body, dm/dt = c m x A m with a diagonal
/// matrix A: the principal moments of inertia 1/A_1, 1/A_2, 1/A_3, and c.
///
/// Inputs are the states, the run-time parameters and the time, as those of a right-hand side; the
/// outputs depend on parameters only. The bracket {m_1, m_2} = -c m_3 and so on is asked for, and
/// H = sum A_i m_i^2/2 up to a constant: the map depends on A itself, not only on the right-hand
/// side, which a multiple of m^2 does not change.
/// \throws ModelError  naming what is not that of a free body
Program free_body_moments(const SceneHamiltonian& source);

}  // namespace casimir
