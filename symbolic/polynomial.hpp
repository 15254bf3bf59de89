#pragma once

#include <cln/rational.h>
// FLINT's names stay inside this stage: no header that another stage includes may include this one.
#include <flint/fmpq_mpoly.h>
#include <flint/fmpq_mpoly_factor.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace casimir {

class Polynomial;

/// Q[x_1, .., x_n] with sparse distributed polynomials in degree-reverse-lexicographic order.
/// Must outlive its polynomials.
class PolynomialRing {
 public:
  explicit PolynomialRing(std::size_t variables);
  ~PolynomialRing();
  PolynomialRing(const PolynomialRing&) = delete;
  PolynomialRing& operator=(const PolynomialRing&) = delete;

  std::size_t size() const { return size_; }
  Polynomial constant(const cln::cl_RA& value) const;
  Polynomial variable(std::size_t i) const;
  const fmpq_mpoly_ctx_struct* context() const { return context_; }

 private:
  std::size_t size_;
  fmpq_mpoly_ctx_t context_;
};

/// A polynomial with exact rational coefficients. Value semantics; mixing rings is a logic error.
class Polynomial {
 public:
  explicit Polynomial(const PolynomialRing& ring);
  Polynomial(const Polynomial& other);
  Polynomial(Polynomial&& other) noexcept;
  Polynomial& operator=(Polynomial other) noexcept;
  ~Polynomial();

  Polynomial& operator+=(const Polynomial& other);
  Polynomial& operator-=(const Polynomial& other);
  Polynomial& operator*=(const Polynomial& other);
  friend Polynomial operator+(Polynomial a, const Polynomial& b) { return std::move(a += b); }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) { return std::move(a -= b); }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b);
  Polynomial operator-() const;
  Polynomial scaled(const cln::cl_RA& factor) const;
  friend bool operator==(const Polynomial& a, const Polynomial& b);

  Polynomial pow(unsigned long exponent) const;
  Polynomial derivative(std::size_t variable) const;

  bool is_zero() const;
  bool is_constant() const;
  std::size_t terms() const;
  long degree(std::size_t variable) const;  ///< -1 for the zero polynomial
  bool uses(std::size_t variable) const { return degree(variable) > 0; }
  long total_degree() const;

  /// Coefficients c_0, c_1, .. of the powers of one variable; they do not use it.
  std::vector<Polynomial> coefficients(std::size_t variable) const;

  /// The value where variable i is point[i].
  cln::cl_RA evaluate(const std::vector<cln::cl_RA>& point) const;

  /// Irreducible factors over Q with their exponents, and the constant factor first (exponent 1).
  std::vector<std::pair<Polynomial, unsigned long>> factors() const;

  /// The greatest common divisor, with leading coefficient 1.
  static Polynomial gcd(const Polynomial& a, const Polynomial& b);

  /// The rational c for which the polynomial is c times a primitive one with a positive leading
  /// coefficient; 0 for the zero polynomial.
  cln::cl_RA content() const;

  /// Exact quotient; false if `divisor` does not divide.
  bool divide(const Polynomial& divisor, Polynomial* quotient) const;

  /// Division by a list: *this = sum quotients[i] * divisors[i] + remainder.
  Polynomial remainder(const std::vector<Polynomial>& divisors,
                       std::vector<Polynomial>* quotients) const;

  /// Each term as its coefficient and one exponent for each variable, in the ring's order.
  std::vector<std::pair<cln::cl_RA, std::vector<unsigned long>>> term_list() const;

  const PolynomialRing& ring() const { return *ring_; }
  fmpq_mpoly_struct* raw() { return value_; }
  const fmpq_mpoly_struct* raw() const { return value_; }

 private:
  const PolynomialRing* ring_;
  fmpq_mpoly_t value_;
};

}  // namespace casimir
