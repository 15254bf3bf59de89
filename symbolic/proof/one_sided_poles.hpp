#pragma once

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Irreducible functions at whose zeros, at finite states, the Hamiltonian is seen to be infinite,
/// for all values of the parameters at which it has a pole at all: it is a sum of functions that
/// are finite at finite states and of terms c/d with one sign, where d is positive and c is a
/// number, times the same parameters in all of them, or c*log(d). What is infinite there cannot
/// cancel. As in 1/(q1 - q2)^2 + 1/(q2 - q3)^2, -k/r1 - k/r2 and log(r); not 1/r1 - 1/r2, and not
/// p^2/q^2, which may be 0 on q = 0. They are the factors of the d; empty for another Hamiltonian.
std::vector<Polynomial> one_sided_poles(Prover& prover);

}  // namespace casimir
