#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::structure {

/// What a user asks for.
struct SeparationRequest {
  int degree = 0;        ///< highest, of the components of the second bivector
  std::vector<Text> on;  ///< the common zero level of these Casimir functions; or empty
  /// A polynomial in u, or the first of v, w, z, s, lambda that is no name of the case, whose roots
  /// are looked at instead of those of bivectors; or empty.
  std::optional<Text> roots;
};

/// What the texts of a separation call things: by no name of the case.
struct SeparationNames {
  std::string root = "u", sum = "G", rate = "w";
  std::string integral = "F";  ///< a number follows
};

/// Variables u_1, .., u_n on the symplectic leaves in which the integrals F_1, .., F_n separate:
/// the roots of u^n + a_1 u^(n-1) + .. + a_n = 0.
///
/// `separated`: near every point of the level where what `nonzero` lists is not zero, the leaf has
/// canonical coordinates (u_i, p_i), complex ones where the roots are, with n equations
/// f_i(u_i, p_i; F_1, .., F_n) = 0, one for each pair. It is shown by one of three theorems.
/// Refuted: near `point` there are no such equations; of roots that were given alone.
///
/// Theorem 1 (Staeckel). On the leaf of dimension 2n let {F_i, F_j} = 0, {u_i, u_j} = 0,
/// det {u_i, F_j} != 0, and for each i let s_1, .., s_n be polynomials in one variable whose
/// coefficients are constant on the leaf, not all zero at u_i, such that
/// sum_j s_j(u_i) {u_k, F_j} = 0 for k != i. Then G_i = sum_j s_j(u_i) F_j is a function of u_i and
/// its momentum alone. Proof: {u_k, G_i} = 0 for k != i, {G_i, G_k} = 0, as both are sums of
/// products of what vanishes, and w_i = {u_i, G_i} is not zero, since s(u_i) is orthogonal to all
/// rows of the regular matrix {u_k, F_j} but the i-th. So by Jacobi's identity w_i commutes with
/// u_k, G_k for k != i, and is a function of u_i, G_i: there is p_i(u_i, G_i) with {u_i, p_i} = 1.
/// The 2n functions u_i, G_i are independent, as the matrix of their brackets is regular. Checked:
/// the Jacobi identity; that level and bracket belong together (`Leaves`); that the rank of the
/// bracket is 2n at most; all brackets as above, identically on the level; the determinant by that
/// of {a_k, F_j} and the discriminant.
///
/// Where all s_j(u_i) vanish the sum says nothing, but the integrals still separate: on a leaf on
/// which the coefficients are not all zero these points are nowhere dense, and the condition of
/// theorem 3 is closed. A coefficient that is no number is therefore listed in `nonzero`.
///
/// Theorem 2 (Magri; Falqui and Pedroni 2003, Theorem 4.2). Let P' be tangent to the leaves with
/// [P, P'] = 0 and [P', P'] = 0, the roots of det(P' - u P) be u_1, .., u_n, each twice, distinct
/// and independent, and {F_i, F_j} = {F_i, F_j}' = 0. Then u_i have canonical momenta p_i with
/// N* du_i = u_i du_i, N* dp_i = u_i dp_i for N = P' P^(-1), and F_i separate in them: N takes the
/// tangent space of F = const to itself, as that is its own complement for P, and therefore is
/// spanned by vectors d/du_i + sum_j dp_j/du_i d/dp_j, each an eigenvector, so that dp_j/du_i = 0
/// for j != i. Checked as above, and P' by `Leaves::is_tangent`.
///
/// Theorem 3 (after Levi-Civita) is that of `levi_civita_defect`: of two roots that were given it
/// decides.
struct Separation {
  /// sum_j s_j(u) F_j is a function of u and its momentum, for each root u or for one of them.
  struct Relation {
    std::string root;                      ///< as a polynomial; empty where it is any of them
    std::vector<std::string> multipliers;  ///< s_1, .., s_n
    std::string sum;                       ///< of the products
    /// {u, G}^2 as a polynomial in u and the sum G, in the notation of case files; empty where none
    /// was found. Checked on the level.
    std::string equation;
    /// No s_j is a number that is not zero, so that where all s_j vanish nothing is said.
    bool may_vanish = false;
  };
  /// P', as "M1,M2" and "-M3"; empty where the roots were given
  std::vector<std::pair<std::string, std::string>> bivector;
  int degree = 0;                      ///< of its components
  std::vector<std::string> integrals;  ///< F_1, .., F_n, the Hamiltonian first
  SeparationNames names;
  std::vector<std::string> coefficients;  ///< a_1, .., a_n
  std::string polynomial;                 ///< with all of them

  Verdict tangent = Verdict::undecided;     ///< P' to the leaves
  Verdict compatible = Verdict::undecided;  ///< [P, P'] = 0
  Verdict jacobi = Verdict::undecided;      ///< [P', P'] = 0
  Verdict involution = Verdict::undecided;  ///< {F_i, F_j}' = 0
  Verdict commuting = Verdict::undecided;   ///< {u_i, u_j} = 0
  Verdict distinct = Verdict::undecided;    ///< the roots, and coordinates on the tori, at `point`
  Verdict separated = Verdict::undecided;
  /// Whether multipliers s_1, .., s_n were found and checked. Never refuted: others of a higher
  /// degree are not looked at.
  Verdict staeckel = Verdict::undecided;
  std::vector<Relation> relations;  ///< one for all roots, or one for each
  /// A case file with the `[[map]]` from the system to the roots u, the sums G and the brackets
  /// w = {u, G}, and what the prover of claims says of that map; empty where none is made.
  std::string map_case;
  Verdict map = Verdict::undecided;
  std::string no_map;                ///< why none is made, where the integrals separate
  std::vector<std::string> nonzero;  ///< irreducible; where one of them is zero, nothing is said
  std::string point;                 ///< at which none is
  bool real = false;                 ///< all roots are real at `point`, and so near it
  std::string reason;                ///< where `separated` is not proved
};

/// What a search for such variables found.
struct SeparationReport {
  int degree = 0;
  /// n, half the dimension of the leaves on the level, or less at all real points; empty where that
  /// was not computed.
  std::optional<std::size_t> freedom;
  std::vector<std::string> on;                   ///< the level
  std::optional<std::string> bracket_of_motion;  ///< said where the case has no bracket of its own
  std::vector<std::string> integrals;            ///< in involution, that were looked at
  std::vector<Separation> found;                 ///< the first that was proved, or none
  std::size_t examined = 0;                      ///< bivectors that were looked at
  /// Proved where nothing was found: no bivector of that degree obeys the linear conditions, beside
  /// multiples of P by Casimir functions, for generic parameters and these integrals: of others, or
  /// of other combinations, it says nothing.
  bool none = false;
  std::vector<std::string> involved;  ///< the integrals of `none`
  /// Constraints of the case that are no part of the level: all is about the whole space.
  std::vector<std::string> not_used;
  std::string reason;  ///< where nothing was found
  std::vector<std::string> generic;
};

/// Looks for bivectors P' up to a degree that are compatible with that of the case and for which n
/// integrals are in involution, and proves that these separate in the roots of det(P' - u P).
/// Integrals are those of the case and, where these are not enough, those that a search finds; for
/// bare equations of motion a bracket is searched for first. Without a level, that of the case's
/// claims is taken where the integrals need one.
/// \throws CaseError, ModelError, TooMuchMemory, TimeUp
SeparationReport find_separation(const Model& model, const SeparationRequest& request,
                                 const search::Watch& watch = {});

}  // namespace casimir::structure
