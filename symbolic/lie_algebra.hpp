#pragma once

#include <optional>
#include <string>
#include <vector>

namespace casimir {

/// The term `numerator/denominator * x_k` of the linear bracket {x_i, x_j}; indices from 0.
struct StructureConstant {
  std::size_t i, j, k;
  int numerator;
  int denominator = 1;
};

/// A named Lie algebra as the linear bracket on its dual, in the book's sign (minus) convention.
struct LieAlgebra {
  std::string name;
  std::string order;  ///< what stands in the places of the variables, as "M1 M2 M3 g1 g2 g3"
  std::size_t dimension = 0;
  std::vector<StructureConstant> constants;  ///< i < j
};

/// The algebra of that name: so(n) and e(n) for n from 3 to 12, so(3,1), semidirect sums
/// "so(3)+k*R3", l(7) of (1.65), sl(2), h(3). Spaces are ignored. Empty if there is none.
///
/// so(3), so(4), so(3,1), e(3) and the sums are in the body's variables (M, g, ..):
/// {M_i,M_j} = -eps_ijk M_k, {M_i,g_j} = -eps_ijk g_k, and {g_i,g_j} = -kappa eps_ijk M_k with
/// kappa = 1 for so(4), -1 for so(3,1), 0 else. so(n) for n > 4 and e(n) for n > 3 are in the
/// variables J_ij, i < j, row by row: {J_ij,J_jk} = J_ik, {J_ij,p_j} = p_i.
std::optional<LieAlgebra> find_lie_algebra(const std::string& name);

/// The names for which `find_lie_algebra` has an answer, for messages.
std::vector<std::string> lie_algebra_names();

/// What a message about a name that is not among them adds: the nearest one, or all of them.
std::string lie_algebra_hint(const std::string& name);

}  // namespace casimir
