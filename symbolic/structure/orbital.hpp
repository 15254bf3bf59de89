#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/prove.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::structure {

/// A field Y with [X, Y] = g X, X being the motion: its flow takes orbits to orbits.
struct OrbitalSymmetry {
  std::vector<GiNaC::ex> components;
  /// Those that are not zero, with the names of their variables.
  std::vector<std::pair<std::string, std::string>> texts;
  GiNaC::ex factor;         ///< g
  std::string factor_text;  ///< 0 where the field commutes with the motion
  int degree = 0;           ///< of the components
  Verdict verdict = Verdict::undecided;
};

/// What a search for them found, and whether that is all.
struct OrbitalReport {
  int degree = 0;
  /// A basis of all of the degree at most, modulo the fields h X with polynomials h, which are
  /// symmetries of this kind for every motion. Products of one with an integral are others.
  std::vector<OrbitalSymmetry> found;
  std::size_t trivial = 0;           ///< dimension of the space of the fields h X
  bool complete = false;             ///< proved: they span all
  std::string reason;                ///< where not
  std::vector<std::string> generic;  ///< parameters that it is about generic values of
};

/// All polynomial fields Y up to a degree with [X, Y] = X(Y) - Y(X) = g X for a polynomial g:
/// linear equations for the coefficients of both, solved over the field of the parameters. The
/// degree of g is less than that of Y, as deg(g) + deg(X) = deg([X, Y]) < deg(X) + deg(Y).
/// \throws ModelError  where the equations of motion are no polynomials, or zero, or the equations
///     too many
OrbitalReport find_orbital_symmetries(const Model& model, int degree,
                                      const search::Watch& watch = {});

}  // namespace casimir::structure
