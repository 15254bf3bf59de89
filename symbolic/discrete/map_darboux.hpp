#pragma once

#include <string>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::discrete {

/// What a search for discrete Darboux polynomials of a rational map x -> x' found: P(x') = C(x)
/// P(x) with a rational cofactor C made of given factors, so that the map takes the zero level of P
/// into itself where C has a value.
struct MapDarboux {
  /// With cofactors that are no constant 1; proved by multiplying out. No product of others, unless
  /// the map exchanges the factors.
  std::vector<search::DarbouxPolynomial> found;
  /// Products of powers of these that the map keeps, and densities; proved.
  std::vector<search::DarbouxCombination> combinations;
  /// The factors that the cofactors are products of: of the denominators of x', and of the
  /// numerator of its Jacobian determinant, where that is short enough.
  std::vector<std::string> factors;
  bool has_jacobian = true;  ///< these are among the factors
  /// Proved: every other P up to the degree whose cofactor is a number times a product of powers of
  /// the factors is a product of those found, of integrals, and of combinations of those with one
  /// cofactor; all with rational coefficients.
  bool complete = false;
  /// Some were seen whose coefficients are no rational numbers: x + sqrt(3) y and x - sqrt(3) y.
  /// With false there may be such.
  bool has_conjugates = false;
  std::string reason;
};

/// Those up to a degree whose cofactors are products of the factors (Celledoni, Evripidou, McLaren,
/// Owren, Quispel, Tapley and van der Kamp, J. Phys. A 52 (2019) 31LT01). For a birational map all
/// are: where C vanishes and P does not, the map has a pole or contracts a hypersurface.
///
/// With the d-th power of the common denominator D, P(x') is a polynomial Q of a known degree, and
/// C = Q/(P D^d): the numerator of C is a factor of Q, and in its denominator stands a factor of
/// D^d times one of P, of degree d at most. So the exponents are finitely many. For each choice
/// C = c K the equation is a pencil in the coefficients of P modulo a prime, whose eigenvalues c
/// are those of two pencils from different random points; a rational P is among its solutions.
/// \throws ModelError  for a map that is not rational, or with parameters without values
MapDarboux find_map_darboux(const MapModel& map, int degree, const search::Watch& watch = {});

}  // namespace casimir::discrete
