#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/equation/parametric_function.hpp"
#include "symbolic/obstruction/hamiltonian_system.hpp"

namespace casimir::obstruction {

/// A natural Hamiltonian p A p/2 + V(q1, q2), A symmetric and invertible, V homogeneous of an
/// integer degree.
struct HomogeneousPotential {
  std::array<GiNaC::symbol, 2> q;
  std::array<std::array<GiNaC::ex, 2>, 2> inverse_mass;  ///< A: numbers, or functions of parameters
  GiNaC::ex potential;
  long degree = 0;
};

/// The system as such a one, if it is one of two degrees of freedom whose potential is a rational
/// function of a degree other than 0, 2 and -2.
std::optional<HomogeneousPotential> homogeneous_potential(const HamiltonianSystem& system);

/// The functions of the direction that decide about straight lines: in the chart (1, z), or (z, 1).
template <class F>
struct DirectionChart {
  /// \param parameter  the free parameter, where F has one
  DirectionChart(const HomogeneousPotential& system, bool second_is_one,
                 const std::optional<GiNaC::symbol>& parameter);
  F first, second;  ///< A V' in the direction
  F trace;          ///< of A V''
};

/// Conjugate points c with A V'(c) = c, given by their direction, and the eigenvalue of A V''(c)
/// that is not degree - 1.
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
  bool all_directions = false;        ///< V depends on q A^(-1) q only
};

/// Finds them. \throws NotDecided  where V is no rational function
DarbouxPoints darboux_points(const HomogeneousPotential& system);

/// The sum of 1/(lambda - 1) over all points, which is -1 where V is a polynomial of degree k >= 3
/// with k different points, none of them improper, and no lambda is 1 (Maciejewski and Przybylska,
/// Phys. Lett. A 327 (2004) 461); empty where one of these fails.
std::optional<cln::cl_RA> relation_of_all_points(const HomogeneousPotential& system,
                                                 const DarbouxPoints& points);

}  // namespace casimir::obstruction
