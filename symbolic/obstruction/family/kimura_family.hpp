#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/family/real_root.hpp"
#include "symbolic/obstruction/family/riemann_family.hpp"

namespace casimir::obstruction {

/// What Kimura's theorem, or the list of Lame's classes, says of one member of a family.
struct KimuraAt {
  bool known = false;     ///< no condition of the family vanishes there
  bool solvable = true;   ///< the identity component of the group; where not known, true
  std::string condition;  ///< where it is known and solvable: which holds
};

/// Decides the member at a real algebraic number c, exactly: a product of m +- s1 +- s2 +- s3 over
/// all signs, s_i^2 the functions of the family, is a function of c that vanishes where a sum of
/// the differences is the odd integer m; differences of Schwarz's list are rational numbers.
KimuraAt kimura_at(const RiemannFamily& family, const RealRoot& c);

/// The product over all signs of m + s1 + s2 + s3, s_i^2 = squares[i]: a function of c.
RationalFunction product_of_sums(long m, const std::array<RationalFunction, 3>& squares);

/// An open interval of numbers c between two neighbouring points of a list that has all zeros and
/// poles of the squares of a family and of their derivatives: each is monotone and has one sign.
struct Cell {
  std::optional<RealRoot> low, high;  ///< empty: infinite
  cln::cl_RA inside;                  ///< a number of the interval
  std::string text(const std::string& name) const;
};

/// Polynomials among whose roots are all c of a cell at which the family's member has a solvable
/// identity component; empty where the cell may have infinitely many.
///
/// A sum of real differences with signs is at most the sum of their bounds on the cell; imaginary
/// ones have to cancel in a sum that is an odd integer, and are in no row of Schwarz's list but the
/// first. \throws NotDecided  where all members are solvable
std::optional<std::vector<Univariate>> candidates(const RiemannFamily& family, const Cell& cell);

/// Whether every member has a solvable identity component, or it looks so: such a family says
/// nothing.
bool says_nothing(const RiemannFamily& family);

/// Where two squares are rational numbers: what the third has to be, as
/// "c = 12/(s^2 - 1/4) with s = 2*p + r for an integer p and r in {1/2}"; else Kimura's conditions
/// in words.
std::string condition_text(const RiemannFamily& family, const std::string& name);

}  // namespace casimir::obstruction
