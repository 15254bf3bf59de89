#pragma once

#include "symbolic/proof/prover.hpp"

namespace casimir {

/// Non-commutative integrability with more integrals than half the dimension 2n of the generic
/// leaf.
///
/// Theorem (Mishchenko and Fomenko 1978): let k integrals be independent on the leaf, their
/// brackets be functions of them, and the matrix {F_i, F_j} have rank 2k - 2n. Then the joint
/// levels are isotropic, of dimension 2n - k, and their compact parts are tori with quasi-periodic
/// motion. Where k > n these are smaller than those of Liouville's theorem. The number k alone says
/// nothing: of the Henon-Heiles system beside two degrees of freedom at rest H, q3, p3, q4, p4 are
/// five integrals on leaves of dimension eight, and its motion is chaotic.
void decide_superintegrability(Prover& prover, Proof& proof);

}  // namespace casimir
