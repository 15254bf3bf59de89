#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::structure {

/// A one-parameter group of linear maps x -> exp(s D) x that keeps the bracket and the Hamiltonian.
struct LinearSymmetry {
  std::vector<std::pair<std::string, std::string>> field;  ///< D x, by variable, where not zero
  /// F with D x = P dF; empty where there is no polynomial one of degree 1 or 2.
  std::string integral;
  Verdict verdict = Verdict::undecided;  ///< that F is an integral; or that L_Y P = 0 and Y(H) = 0
};

/// What a search for them found.
struct SymmetryReport {
  std::vector<LinearSymmetry> found;  ///< a basis of their Lie algebra
  bool complete = false;              ///< there are no others, for generic parameters
  std::string reason;
  std::vector<std::string> generic;
};

/// The linear fields Y = D x with L_Y P = 0 and Y(H) = 0, for a polynomial bracket P and
/// Hamiltonian H; and where one is the Hamiltonian field of F, that integral.
///
/// Theorem (Noether): if Y = P dF and Y(H) = 0, then {F, H} = -Y(H) = 0. The equations for D are
/// linear: all solutions are found, and for generic values of the parameters there are no others,
/// where the assumptions leave generic values (`thin_domain`).
/// That a Y without F is a symmetry is the solution of these equations itself.
/// \throws ModelError  where the bracket or the Hamiltonian is no polynomial, or there is none
SymmetryReport linear_symmetries(const Model& model, const search::Watch& watch = {});

}  // namespace casimir::structure
