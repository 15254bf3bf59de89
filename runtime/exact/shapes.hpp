#pragma once

#include "runtime/exact/closed_form.hpp"
#include "runtime/exact/polynomial_field.hpp"

namespace casimir::exact {

/// The equations and the start of a motion that may have one of the shapes of closed_form.hpp.
struct Motion {
  const std::vector<ExactPolynomial>& field;
  const std::vector<cln::cl_F>& initial;

  std::size_t states() const { return initial.size(); }
  cln::cl_F number(int value) const { return cln::cl_float(cln::cl_RA(value), initial.front()); }
  cln::cl_F zero() const { return number(0); }
  /// The coefficient of a product in a rate, given by its exponents; zero if it is not there.
  cln::cl_F coefficient(std::size_t rate, const std::vector<int>& exponents) const {
    const auto at = field[rate].find(exponents);
    return at == field[rate].end() ? zero() : at->second;
  }
};

/// A part of the parameter of elliptic functions: what is smaller is a separatrix, as far as the
/// digits tell.
cln::cl_F undecided_part(const cln::cl_F& like);
/// For how many units of their argument elliptic functions are then those of a separatrix, to more
/// digits than double has.
inline constexpr double kSeparatrixHorizon = 200;

/// Of a state that is right but for its last digit.
inline constexpr double kRoundedError = 0x1p-53;
/// Of what is evaluated in double precision at an argument of that size.
inline double evaluated_error(double argument) { return 8 * kRoundedError * (1 + argument); }

/// Beside what a number of some size is taken for zero.
cln::cl_F vanishing_part(const cln::cl_F& like);
/// Whether the coefficients of two fields agree, as far as the digits tell. That they differ by
/// less changes the motion by less than any digit that is given.
bool same_field(const std::vector<ExactPolynomial>& a, const std::vector<ExactPolynomial>& b);
/// The rates at the start.
std::vector<cln::cl_F> start_rates(const Motion& motion);
/// Whether all of them are zero; fields without sines and cosines only.
bool rests(const Motion& motion);

/// Of a motion that is none.
Recognised at_rest(const Motion& motion);

// Each of these: a form, or why there is none.
Recognised free_body(const Motion& motion);
Recognised pendulum(const Motion& motion);
Recognised polynomial_force(const Motion& motion);
Recognised gyrostat(const Motion& motion);
Recognised symmetric_top(const Motion& motion);

}  // namespace casimir::exact
