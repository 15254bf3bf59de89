#pragma once

#include "symbolic/structure/separate/roots.hpp"

namespace casimir::structure {

/// What has to vanish for two integrals F_1, F_2 to separate in two roots, and is enough: one
/// function, by its coefficients of 1 and of a root, with all denominators multiplied out.
///
/// Theorem 3 (after Levi-Civita 1904). On a leaf of dimension 2n let {u_i, u_j} = {F_i, F_j} = 0
/// and the matrix A = ({u_i, F_j}) be regular, B its inverse. There are momenta p_i of u_i and n
/// equations f_i(u_i, p_i; F) = 0 if and only if B_ki, in the coordinates (u, F), depends on u_i
/// and F alone. Proof: let Q_k be functions with {Q_k, F_l} = delta_kl, {Q_k, Q_l} = 0, and p' any
/// momenta of u (Caratheodory, Jacobi, Lie); S(u, F) with p' = dS/du, Q = dS/dF generates. Then
/// B_ki = dQ_k/du_i = d^2 S/du_i dF_k. If that is a function of u_i and F, S is a sum of functions
/// W_i(u_i, F) and of g(u), and p_i = p'_i - dg/du_i = dW_i/du_i. Conversely B_ki = d^2 W_i/du_i
/// dF_k.
///
/// For n = 2 it is enough that the ratio of the two entries of each column depends on u_i and F
/// alone: let B_21 = r B_11, B_22 = s B_12; as dB_k1/du_2 = dB_k2/du_1, e = dB_11/du_2 = dB_12/du_1
/// and r e = s e, and r = s would make B singular. So e = 0. (Where B_11 or B_12 is zero, with the
/// reciprocal ratios.) The derivative along u_2 at fixed F is, up to a factor,
/// {u_1, F_1} {., F_2} - {u_1, F_2} {., F_1}, and r = -{u_2, F_1}/{u_2, F_2}.
std::vector<Polynomial> levi_civita_defect(const Leaves& leaves, const RootCoefficients& a,
                                           const std::vector<Polynomial>& integrals);

}  // namespace casimir::structure
