#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/obstruction/equation/univariate.hpp"

namespace casimir::obstruction {

/// What the variables are called in print.
struct CurveNames {
  std::string z;                          ///< the coordinate on the curve
  std::string parameter;                  ///< the free parameter; empty without one
  std::vector<std::string> further = {};  ///< more free parameters
};

/// An element of Q(c)(z): a quotient of two polynomials in a parameter c (or up to four of them)
/// and a variable z, in lowest terms, the denominator with leading coefficient 1.
class ParametricFunction {
 public:
  ParametricFunction();
  ParametricFunction(int constant);
  ParametricFunction(const cln::cl_RA& constant);
  /// \throws std::domain_error  for a zero denominator
  ParametricFunction(Polynomial numerator, Polynomial denominator);

  static ParametricFunction variable();  ///< z
  /// c, or one of the further parameters.
  static ParametricFunction parameter(std::size_t i = 0);
  /// Of a polynomial in c.
  static ParametricFunction of_parameter(const Univariate& polynomial);
  static constexpr std::size_t kParameter = 0, kVariable = 1;  ///< their places in the ring
  static constexpr std::size_t kMostParameters = 4;            ///< the others stand behind

  const Polynomial& numerator() const { return numerator_; }
  const Polynomial& denominator() const { return denominator_; }
  bool is_zero() const { return numerator_.is_zero(); }
  /// Whether z is in it.
  bool uses_variable() const;
  /// As a function of c alone. \throws std::logic_error  where z is in it
  RationalFunction in_parameter() const;
  /// The value where c is a number. \throws std::domain_error  where the denominator vanishes there
  RationalFunction at_parameter(const cln::cl_RA& value) const;

  friend ParametricFunction operator+(const ParametricFunction& a, const ParametricFunction& b);
  friend ParametricFunction operator-(const ParametricFunction& a, const ParametricFunction& b);
  friend ParametricFunction operator*(const ParametricFunction& a, const ParametricFunction& b);
  /// \throws std::domain_error  for a zero divisor
  friend ParametricFunction operator/(const ParametricFunction& a, const ParametricFunction& b);
  friend ParametricFunction operator-(const ParametricFunction& a);

  /// With respect to z.
  ParametricFunction derivative() const;
  /// f with f^2 equal to this one, if it is in Q(c)(z).
  std::optional<ParametricFunction> square_root() const;

 private:
  Polynomial numerator_, denominator_;
};

/// A polynomial in c alone. \throws std::logic_error  where z is in it
Univariate in_parameter(const Polynomial& polynomial);

/// The coefficients of the powers of z, from degree 0 on, as polynomials in c.
std::vector<Univariate> parameter_coefficients(const Polynomial& polynomial);

/// The same with any parameters in them.
std::vector<ParametricFunction> variable_coefficients(const Polynomial& polynomial);

/// A quotient in print, with the denominator factorised.
std::string written(const ParametricFunction& f, const CurveNames& names);
std::string written(const RationalFunction& f, const CurveNames& names);

/// The degrees in z of numerator and denominator, added up.
long total_degree(const ParametricFunction& f);
long total_degree(const RationalFunction& f);
/// The degree in z of the denominator.
long pole_count(const ParametricFunction& f);
long pole_count(const RationalFunction& f);

/// Whether the leading coefficient by z is a negative number. \throws NotDecided  where it is none
bool leads_with_minus(const ParametricFunction& f);
bool leads_with_minus(const RationalFunction& f);

/// Polynomials in the parameters that must not vanish, irreducible and monic, each once. Where a
/// function of z shall not be zero, the coefficients have no common zero c; with several parameters
/// it is asked for more, that the leading one has none.
class ParameterConditions {
 public:
  /// f is to be a function of z that has a value and is not zero.
  void nonzero(const ParametricFunction& f);
  /// Nothing depends on a parameter.
  void nonzero(const RationalFunction&) {}
  void nonzero(const Univariate& polynomial);
  void nonzero(const Polynomial& polynomial);
  /// That f has a value.
  void defined(const ParametricFunction& f);
  void add(const ParameterConditions& others);
  const std::vector<Univariate>& polynomials() const { return polynomials_; }
  /// Those in which there are further parameters.
  const std::vector<Polynomial>& several() const { return several_; }

 private:
  std::vector<Univariate> polynomials_;
  std::vector<Polynomial> several_;
};

}  // namespace casimir::obstruction
