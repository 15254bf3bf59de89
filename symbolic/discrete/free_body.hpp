#pragma once

#include <string>
#include <vector>

#include "symbolic/functions/function_ring.hpp"

namespace casimir::discrete {

/// A free rigid body {m_1, m_2} = s m_3 and so on, H = (a_1 m_1^2 + a_2 m_2^2 + a_3 m_3^2)/2, with
/// everything in the function ring of its case: the variables are the first three symbols.
struct FreeBody {
  /// J_i = scale * (1/a_j + 1/a_k - 1/a_i)/2, without denominators that depend on parameters.
  std::vector<Polynomial> tensor;
  Polynomial scale;
  cln::cl_RA bracket;               ///< s; -1 for dm/dt = m x grad H
  std::vector<Polynomial> nonzero;  ///< what has to be different from 0: numerators of the a_i
};

/// \param ring  has the symbols of the case and its Hamiltonian
/// \throws ModelError  that says what is missing for a free body
FreeBody free_body(const Model& flow, FunctionRing& ring);

/// Says of what is no free body what is missing.
/// \throws ModelError
[[noreturn]] void refuse_free_body(const std::string& missing);

}  // namespace casimir::discrete
