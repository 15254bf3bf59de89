#pragma once

#include <cln/rational.h>
// FLINT's names stay inside this stage: no header that another stage includes may include this one.
#include <flint/fmpq_poly.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace casimir::obstruction {

/// A polynomial in one variable with exact rational coefficients. Value semantics.
class Univariate {
 public:
  Univariate() { fmpq_poly_init(value_); }
  Univariate(const cln::cl_RA& constant);
  Univariate(int constant) : Univariate(cln::cl_RA(constant)) {}
  /// Of the coefficients of degree 0, 1, ..
  explicit Univariate(const std::vector<cln::cl_RA>& coefficients);
  Univariate(const Univariate& other);
  Univariate(Univariate&& other) noexcept;
  Univariate& operator=(Univariate other) noexcept;
  ~Univariate() { fmpq_poly_clear(value_); }

  /// The variable.
  static Univariate variable();

  /// -1 for the zero polynomial.
  long degree() const { return fmpq_poly_degree(value_); }
  bool is_zero() const { return fmpq_poly_is_zero(value_) != 0; }
  bool is_constant() const { return degree() <= 0; }
  cln::cl_RA coefficient(long i) const;
  cln::cl_RA leading() const { return coefficient(degree()); }
  cln::cl_RA at(const cln::cl_RA& point) const;

  Univariate& operator+=(const Univariate& other);
  Univariate& operator-=(const Univariate& other);
  Univariate& operator*=(const Univariate& other);
  friend Univariate operator+(Univariate a, const Univariate& b) { return std::move(a += b); }
  friend Univariate operator-(Univariate a, const Univariate& b) { return std::move(a -= b); }
  friend Univariate operator*(Univariate a, const Univariate& b) { return std::move(a *= b); }
  friend Univariate operator-(Univariate a) { return std::move(a *= Univariate(-1)); }
  friend bool operator==(const Univariate& a, const Univariate& b) {
    return fmpq_poly_equal(a.value_, b.value_) != 0;
  }

  Univariate derivative() const;
  Univariate pow(unsigned long exponent) const;
  /// Divided by its leading coefficient.
  Univariate monic() const;
  /// At another polynomial.
  Univariate composed(const Univariate& inner) const;
  /// Quotient and remainder. \throws std::domain_error  for a zero divisor
  std::pair<Univariate, Univariate> divided(const Univariate& divisor) const;
  Univariate remainder(const Univariate& modulus) const { return divided(modulus).second; }
  /// The inverse modulo a polynomial that has no common factor with this one.
  /// \throws std::domain_error  where there is a common factor
  Univariate inverse(const Univariate& modulus) const;

  /// Monic irreducible factors over the rational numbers with their exponents, without the
  /// constant.
  std::vector<std::pair<Univariate, unsigned long>> factors() const;

  /// As "z^2 - 3/4*z + 1".
  std::string text(const std::string& variable) const;

  const fmpq_poly_struct* raw() const { return value_; }
  fmpq_poly_struct* raw() { return value_; }

 private:
  fmpq_poly_t value_;
};

/// The greatest common divisor, monic.
Univariate gcd(const Univariate& a, const Univariate& b);

/// A quotient of two polynomials in lowest terms with a monic denominator.
class RationalFunction {
 public:
  RationalFunction() : denominator_(1) {}
  RationalFunction(int constant) : RationalFunction(Univariate(constant)) {}
  RationalFunction(const cln::cl_RA& constant) : RationalFunction(Univariate(constant)) {}
  RationalFunction(Univariate numerator) : RationalFunction(std::move(numerator), Univariate(1)) {}
  /// \throws std::domain_error  for a zero denominator
  RationalFunction(Univariate numerator, Univariate denominator);

  const Univariate& numerator() const { return numerator_; }
  const Univariate& denominator() const { return denominator_; }
  bool is_zero() const { return numerator_.is_zero(); }
  bool is_constant() const { return numerator_.is_constant() && denominator_.is_constant(); }

  friend RationalFunction operator+(const RationalFunction& a, const RationalFunction& b);
  friend RationalFunction operator-(const RationalFunction& a, const RationalFunction& b);
  friend RationalFunction operator*(const RationalFunction& a, const RationalFunction& b);
  /// \throws std::domain_error  for a zero divisor
  friend RationalFunction operator/(const RationalFunction& a, const RationalFunction& b);
  friend RationalFunction operator-(const RationalFunction& a) { return RationalFunction(0) - a; }
  friend bool operator==(const RationalFunction& a, const RationalFunction& b) {
    return a.numerator_ == b.numerator_ && a.denominator_ == b.denominator_;
  }

  RationalFunction derivative() const;
  RationalFunction pow(long exponent) const;
  /// f with f^2 equal to this one, if its coefficients are rational.
  std::optional<RationalFunction> square_root() const;

  /// With its denominator factorised.
  std::string text(const std::string& variable) const;

 private:
  Univariate numerator_, denominator_;
};

/// The root of a rational number that is a square of one.
std::optional<cln::cl_RA> square_root(const cln::cl_RA& value);

/// s with s^2 = value modulo an irreducible polynomial f: a square root in the number field Q[z]/f.
/// The characteristic polynomial C of value*q^2 is irreducible of the degree of f where that number
/// generates the field (q is chosen so). A root x of C(x^2) lies in the field if and only if C(x^2)
/// is reducible, M(x)*M(-x) up to a sign, and M has it by its even and odd parts.
std::optional<Univariate> square_root(const Univariate& value, const Univariate& f);

}  // namespace casimir::obstruction
