#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// A natural Hamiltonian p A p/2 + V(q1, .., qn), n at least 3, V homogeneous of an integer degree.
struct PotentialInSpace {
  std::vector<GiNaC::symbol> q;
  std::vector<GiNaC::ex> slopes;                   ///< A V'
  std::vector<std::vector<GiNaC::ex>> curvatures;  ///< A V''
  GiNaC::ex determinant;                           ///< of A, not zero
  long degree = 0;                                 ///< other than 0, 2 and -2
};

/// The system as such a one, if it is one whose potential is a rational function of the variables,
/// and of the free parameter if there is one, of which A may be a function too.
std::optional<PotentialInSpace> potential_in_space(const HamiltonianSystem& system);

/// Whether it is a number of Q.
bool is_rational_number(const GiNaC::ex& e);

}  // namespace casimir::obstruction
