#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::structure {

/// A Poisson bracket of a motion.
struct Bracket {
  std::vector<GiNaC::ex> upper;  ///< {x_i, x_j}, i < j, row by row
  /// Those that are not zero, as "M1,M2" and "-M3": a table [phase_space.brackets].
  std::vector<std::pair<std::string, std::string>> texts;
  std::optional<GiNaC::ex> hamiltonian;  ///< with which it gives the motion, if one was found
  std::string hamiltonian_text;
  std::vector<std::string> casimirs;  ///< polynomial ones, each proved
  /// Functions C_0, C_1, .. with P' dC_0 = 0, P' dC_(k+1) = P dC_k and P dC_K = 0 at the end, P
  /// being the first bracket and P' this one. Of a second bracket only.
  std::vector<std::vector<std::string>> chains;
  std::vector<std::size_t> compatible;  ///< numbers of the other ones found that it may be added to
  int degree = 0;
  Verdict jacobi = Verdict::undecided;  ///< the Jacobi identity
  Verdict motion = Verdict::undecided;  ///< that the motion is that of the Hamiltonian
};

/// What a search for brackets found, and whether that is all.
struct BracketReport {
  int degree = 0;                ///< highest, of the components
  int hamiltonian_degree = 0;    ///< highest, of the Hamiltonian
  std::optional<Bracket> first;  ///< of a search for second brackets: the one they belong to
  std::vector<Bracket> found;    ///< none of them a linear combination of others
  std::size_t families = 0;      ///< of solutions of the equations for the constants
  /// Proved where it is complete: every such bracket is a linear combination of those found (and
  /// the first), as the invariant bivectors have no more dimensions.
  bool spanned = false;
  std::size_t invariant = 0;  ///< dimension of the space of invariant bivectors of that degree
  /// Proved: every such bracket belongs to one of the families; there is none where these are none.
  bool complete = false;
  /// Proved where it is complete and nothing was found: no bracket whatever the Hamiltonian.
  bool whatever_hamiltonian = false;
  std::string reason;  ///< where it is not complete
  std::vector<std::string> generic;
};

/// The Poisson brackets P with polynomial components up to a degree for which the equations of
/// motion X are Hamiltonian, X = P dH, with a polynomial H of the degree of X plus one. What the
/// case says of a bracket is not looked at.
///
/// Theorem: if P is Poisson and X = P dH, then L_X P = 0 and X(H) = 0. So P is in the space of the
/// invariant bivectors, and H in that of the integrals; the rest are polynomial equations for the
/// constants. Where there is no invariant bivector there is no such bracket with any H that is
/// twice differentiable, on whatever open set. Checked: that the spaces are complete, that all
/// cases of the equations were solved, that no parameter is bound to others.
/// \throws ModelError  where the equations are not polynomials; TooMuchMemory, TimeUp
BracketReport find_brackets(const Model& model, int degree, const search::Watch& watch = {});

/// The Poisson brackets up to a degree that are invariant and compatible with that of the case (or
/// the first one that is found for bare equations), less multiples of it.
/// \throws as find_brackets
BracketReport find_second_brackets(const Model& model, int degree, const search::Watch& watch = {});

}  // namespace casimir::structure
