#pragma once

#include <functional>

#include "symbolic/obstruction/hamiltonian_system.hpp"
#include "symbolic/obstruction/obstruct.hpp"

namespace casimir::obstruction {

/// Adds what the straight lines of a homogeneous potential of three and more degrees of freedom
/// show, where the system has one: p A p/2 + V(q1, .., qn) with an invertible A, V rational and
/// homogeneous of an integer degree k but 0, 2, -2. Sets `proved`.
///
/// A Darboux point is a c with A V'(c) = c; its direction d has A V'(d) = gamma d with gamma not 0,
/// and A V''(c) = A V''(d)/gamma. k - 1 is an eigenvalue, with eigenvector c. For every other one,
/// lambda, y'' = -lambda phi^(k-2) y is a part of the variational equations along the line, whether
/// the matrix is diagonalisable or not: its eigenvector gives a submodule of their adjoint. So each
/// has to stand in the table of Morales-Ruiz and Ramis (2001); its entries are rational.
///
/// All directions are sought, as common zeros of polynomials (`common_zeros`); where there are
/// infinitely many, those in some coordinate planes. What is said of a point rests on no others.
void examine_lines_in_space(const HamiltonianSystem& system, const std::function<void()>& tick,
                            Obstruction& result);

}  // namespace casimir::obstruction
