#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/obstruction/equation/parametric_function.hpp"

namespace casimir::obstruction {

/// Riemann's P equation, or Lame's, its coefficients functions of a real parameter c.
struct RiemannFamily {
  bool lame = false;                  ///< Lame's: squares[2] is (n + 1/2)^2, the others are 1/4
  std::array<std::string, 3> points;  ///< its singular points, in print
  std::array<RationalFunction, 3> squares;  ///< of the differences of exponents there, by c
  ParameterConditions conditions;           ///< where one vanishes, nothing is said of c
};

/// The same with functions of several parameters.
struct GeneralFamily {
  bool lame = false;
  std::array<std::string, 3> points;
  std::array<ParametricFunction, 3> squares;
  ParameterConditions conditions;
};

/// The family of one parameter. \throws std::logic_error  where there are more
RiemannFamily of_one_parameter(const GeneralFamily& family);

/// y'' = r y as such an equation, if its denominator has no more than two zeros for almost every c
/// and infinity is no irregular point. Two conjugate points have to have one difference.
///
/// Where none of the conditions vanishes, the equation at the number c is Riemann's with these
/// differences: the denominators' leading coefficients, and the distances of the points, are among
/// the conditions.
std::optional<GeneralFamily> riemann_family(const ParametricFunction& r, const CurveNames& names);

/// y'' + p y' + q y = 0, if it is Lame's equation for almost every c.
/// \param r  of its reduced form
std::optional<GeneralFamily> lame_family(const ParametricFunction& p, const ParametricFunction& q,
                                         const ParametricFunction& r, const CurveNames& names);

}  // namespace casimir::obstruction
