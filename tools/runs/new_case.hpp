#pragma once

#include <cln/rational.h>

#include <string>
#include <utility>
#include <vector>

#include "symbolic/lie_algebra.hpp"

namespace casimir::tools {

/// A variable or parameter with its exact value in the scene.
struct NewQuantity {
  std::string name;
  cln::cl_RA value;
  bool positive = false;  ///< a parameter that is assumed to be
};

using NamedText = std::pair<std::string, std::string>;

/// What a case file to start from says; every claim of it is true.
struct NewCase {
  std::string about;        ///< the Hamiltonian or the equations, in words
  std::string phase_space;  ///< the line that gives the bracket; empty where equations do
  std::vector<NewQuantity> variables, parameters;
  std::string hamiltonian;  ///< empty where there are equations
  std::vector<NamedText> equations, casimirs, integrals;
  std::vector<std::string> levels;  ///< functions that vanish in the scene; at least one
};

/// A top on the dual of that algebra: kinetic energy, and where some variables commute a potential
/// linear in them; with the algebra's Casimir functions up to degree 2.
NewCase new_on_algebra(const LieAlgebra& algebra);

/// `n` oscillators in q1..qn, p1..pn.
NewCase new_canonical(int n);

/// A chain of `n` equations without a bracket.
NewCase new_equations(int n);

/// The commented file of a case of that name; `file` is what its comments call it. Keys that are
/// commented out may be switched on as they stand, except `integrable`.
std::string to_toml(const NewCase& system, const std::string& name, const std::string& file);

}  // namespace casimir::tools
