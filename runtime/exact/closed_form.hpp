#pragma once

#include <cln/float.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/exact/elliptic.hpp"
#include "runtime/module.hpp"
#include "runtime/program.hpp"

namespace casimir {

/// A solution in closed form: the state at any time, without steps.
class ClosedForm {
 public:
  virtual ~ClosedForm() = default;
  /// The state after a time, as good at the last of a million periods as in the first.
  virtual void at(const TwoDoubles& elapsed, double* x) const = 0;
  /// The time that the motion needs to show what it is: a period where there is one.
  virtual double period() const = 0;
  /// From where on the numbers that the form was made of do not say on which side of a separatrix
  /// the motion is; infinite elsewhere.
  virtual double horizon() const = 0;
  /// About how much the state is off at most, in parts of `reach`, or of the largest values on the
  /// way where that is empty: what is left of rounding, since the form is made of the exact numbers
  /// of the scene.
  virtual double error() const = 0;
  /// The largest values of the states over a period, where these are what the error is a part of: a
  /// run that is shorter may not come near them, and then its values are off by more of their own.
  virtual std::vector<double> reach() const { return {}; }
};

/// A closed form, or why there is none.
struct Recognised {
  std::shared_ptr<const ClosedForm> form;
  std::string reason;  ///< a sentence, where there is none
};

/// The solution from a start, where the equations, whatever they are called, have one of these
/// shapes. The theorem is the verification of the formula by differentiation, which stands beside
/// the code; what it assumes is the shape itself, read off the exact equations of the scene, and
/// what is said here of coefficients. All else is refused.
///
/// - x' = a y z, y' = b z x, z' = c x y in any order of three states, where a, b, c have not all
/// the
///   same sign (then solutions have poles), and at most one is zero, while the other two have
///   opposite signs, or all are: the free rigid body.
/// - q' = a p, p' = b sin q + c cos q: the pendulum.
/// - q' = a p, p' = a polynomial of degree three or less in q, where the motion is bounded: all
///   solutions of one degree of freedom that are elliptic functions of the time.
/// - x' = x * (A x + k) with a vector product, a symmetric matrix A and a vector k: the gyrostat.
/// - Of six states, a momentum M and a direction g, each in the order of the axes, with one axis
///   (3 here) along which nothing but g_3 changes: M_1' = P M_2 + r g_2, M_2' = -P M_1 - r g_1,
///   M_3' = 0, g_1' = B g_2 - a g_3 M_2, g_2' = -B g_1 + a g_3 M_1, g_3' = a (g_1 M_2 - g_2 M_1),
///   P and B of the form number + number * M_3: the symmetric top and the spherical pendulum.
///
/// \param initial  the state at the start, with `kExactDigits` digits.
Recognised closed_form(const Program& rhs, const std::vector<cln::cl_F>& initial);

/// Runs by a closed form. From the start of the scene it is the one given; from any other state one
/// that is made for it.
/// \param start  what `initial` is in double precision.
std::function<ModuleFunctions::Integration> exact_integration(
    const Program& rhs, const std::vector<cln::cl_F>& initial, std::vector<double> start,
    std::shared_ptr<const ClosedForm> form);

}  // namespace casimir
