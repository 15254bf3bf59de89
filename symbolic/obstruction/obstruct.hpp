#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/obstruction/certificate/no_polynomial.hpp"
#include "symbolic/search/watch.hpp"

namespace casimir::obstruction {

/// A curve and its normal variational equation as expressions in the variables of the case.
struct CurveExpressions {
  std::vector<std::pair<GiNaC::ex, GiNaC::ex>> curve;  ///< left and right sides: px^2 = ..
  std::string unknown;                                 ///< of the equation, a name of no variable z
  GiNaC::ex p, q, reduced;                             ///< y'' + p y' + q y = 0, and r of y'' = r y
};

/// One question to the Galois group: a curve, an equation along it, and what is known of the group.
struct Examined {
  std::string along;                                       ///< the surface or the straight line
  std::string level;                                       ///< of H and the Casimir functions
  std::string curve;                                       ///< the equations of the curve on it
  std::string nve;                                         ///< the normal variational equation
  std::string reduced;                                     ///< y'' = r y
  std::vector<std::string> exponents;                      ///< the singular points
  std::vector<std::pair<std::string, std::string>> cases;  ///< what was tried, and what came of it
  std::string solution;   ///< a polynomial for w = y'/y, where there is one
  std::string outcome;    ///< as "SL(2, C)"
  std::string where;      ///< with a free parameter: what it is said of, as "a3 - 1 != 0"
  bool decisive = false;  ///< it proves that there is no further integral
  bool regular = true;    ///< no irregular singular point
  unsigned order = 1;     ///< of the variational equation that decides
  std::vector<NoPolynomial> steps = {};              ///< the linear algebra of the proof
  std::optional<CurveExpressions> expressions = {};  ///< along surfaces, without a free parameter
};

/// A real value of the free parameter that no equation excludes for all values alike.
struct FreeValue {
  std::string value;           ///< as "1/4", or as "the root of c^2 - 2 near 1.41421"
  std::string why;             ///< the conditions that hold
  bool excluded = false;       ///< when it is examined alone
  bool only_rational = false;  ///< not excluded, but that there is no further rational integral
  std::string outcome;         ///< what came of that
};

/// Real values of the free parameter that are not excluded where all conditions hold.
struct FreeSequence {
  std::string range;                    ///< as "c > 0"
  std::vector<std::string> conditions;  ///< as "12/c + 1/4 = (2*p + r)^2 for an integer p .."
};

/// Whether a further integral is excluded, and by what.
struct Obstruction {
  bool proved = false;  ///< that there is no further meromorphic integral
  /// Not proved, but that there is no further rational one: which of `examined` is decisive.
  std::optional<std::size_t> rational = {};
  std::string free;                     ///< the free parameters, with commas; empty without one
  std::vector<std::string> assumed;     ///< what the case assumes of these
  std::vector<FreeValue> values;        ///< that survive, in order
  std::vector<FreeSequence> sequences;  ///< of values that survive
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and value
  std::string theorem;                ///< where proved, if only of rational integrals: which
  std::string excluded;               ///< the same: which integrals, and where
  std::string reason;                 ///< where not proved: why
  std::vector<Examined> examined;     ///< where proved, the decisive one is the last
  std::vector<std::string> left_out;  ///< surfaces and levels that gave nothing to examine
};

/// What is asked.
struct ObstructionRequest {
  std::string scene = "default";  ///< whose values the parameters have
  std::vector<Text> along;        ///< equations of an invariant surface; none: it is sought
  /// Parameters that keep their symbols, with commas: which values survive?
  std::string free = {};
  unsigned order = 3;  ///< the highest of the variational equations that are examined
};

/// Looks for a curve along which the identity component of the Galois group of the variational
/// equations is not solvable, and so not abelian: then there are not as many meromorphic integrals
/// in involution as degrees of freedom (Morales-Ruiz and Ramis, Methods Appl. Anal. 8 (2001) 33 and
/// 97).
///
/// The theorem is about n integrals that are meromorphic in a neighbourhood of the complex curve,
/// in involution and functionally independent there; it says that the group's identity component,
/// and so that of every equation which the variational ones are taken apart into, is abelian. The
/// curve is followed on all loops around its singular points, be they in the domain or not: H = (1
/// + x^2) px + (py^2 + (1 + x) y^2)/2 has another integral that is analytic at all real points, and
/// many-valued about x = i. Checked: that there are real points at all (`has_inner_points`),
/// that the curve is a solution and no point of rest (`make_curve`), that the surface is invariant
/// and the level a symplectic leaf along the curve (`normal_variation`), that the group has no
/// solvable identity component (`decide_liouvillian`). Where the equation has an irregular singular
/// point, its coefficients are taken from the algebraic functions on the curve, and only integrals
/// with algebraic coefficients there, such as rational ones, are excluded: H = px + (py^2 + x
/// y^2)/2 has the entire integral y Ai'(x) - py Ai(x), and the group SL(2, C) of Airy's equation.
///
/// Where all equations of first order have a solvable identity component, those of higher order are
/// examined where `examine_higher` can.
///
/// With a free parameter `proved` is about every real value of it that is `assumed`, but those in
/// `values` and `sequences`; what is said of each equation holds where `Examined::where` does.
/// \throws CaseError  for an equation of a surface that cannot be read
Obstruction find_obstruction(const Model& model, const ObstructionRequest& request,
                             const search::Watch& watch = {});

}  // namespace casimir::obstruction
