#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// A natural Hamiltonian (p1^2/m1 + p2^2/m2)/2 + V(q1, q2), V homogeneous, with rational numbers.
struct HomogeneousPotential {
  std::array<GiNaC::symbol, 2> q;
  std::array<cln::cl_RA, 2> mass;
  GiNaC::ex potential;
  long degree = 0;
};

/// Conjugate points c with V'(c) = (m1 c1, m2 c2), given by their direction, and the eigenvalue of
/// the matrix of second derivatives of V (divided by the masses) that is not degree - 1.
struct DarbouxPoint {
  bool vertical = false;  ///< in the direction (0, 1), else (1, t)
  Univariate direction;   ///< monic and irreducible, of which t is a root
  Univariate eigenvalue;  ///< an element of Q[t]/direction
  std::string text(const HomogeneousPotential& system) const;
  std::string eigenvalue_text() const;
};

/// All Darboux points of a planar homogeneous potential.
struct DarbouxPoints {
  std::vector<DarbouxPoint> points;
  std::vector<std::string> improper;  ///< directions in which V' vanishes; they give no line
  bool all_directions = false;        ///< V depends on m1 q1^2 + m2 q2^2 only
};

/// Finds them. \throws NotDecided  where V is no rational function
DarbouxPoints darboux_points(const HomogeneousPotential& system);

}  // namespace casimir::obstruction
