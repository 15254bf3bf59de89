#pragma once

#include <cln/rational.h>
// FLINT's names stay inside this stage: no header that another stage includes may include this one.
#include <flint/fmpq_mpoly.h>
#include <flint/fmpq_mpoly_factor.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace casimir {

class Polynomial;
class FactorMemory;

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
  /// The factors that were found in this ring; may be used from several threads.
  FactorMemory& factor_memory() const { return *factor_memory_; }

 private:
  std::size_t size_;
  std::unique_ptr<FactorMemory> factor_memory_;
  fmpq_mpoly_ctx_t context_;
};

/// A polynomial with exact rational coefficients. Value semantics; mixing rings is a logic error.
class Polynomial {
 public:
  explicit Polynomial(const PolynomialRing& ring);
  Polynomial(const Polynomial& other);
  Polynomial(Polynomial&& other) noexcept;
  Polynomial& operator=(const Polynomial& other);
  Polynomial& operator=(Polynomial&& other) noexcept;
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

  /// The sum of all, merged in pairs: adding many polynomials to one that grows would cost the
  /// square of its length.
  static Polynomial sum(const PolynomialRing& ring, std::vector<const Polynomial*> summands);
  static Polynomial sum(const PolynomialRing& ring, std::vector<Polynomial> summands);

  /// The coefficients of a linear form without constant term as integers over one denominator:
  /// sum_i coefficients[i] x_i / denominator. Empty for any other polynomial, and where a number
  /// does not fit into 31 bits.
  struct LinearForm {
    std::vector<std::pair<std::size_t, long>> coefficients;  ///< variable and coefficient
    long denominator = 1;
  };
  std::optional<LinearForm> linear_form() const;

  /// The value where variable i is point[i].
  cln::cl_RA evaluate(const std::vector<cln::cl_RA>& point) const;

  /// Irreducible factors over Q with their exponents, and the constant factor first (exponent 1).
  std::vector<std::pair<Polynomial, unsigned long>> factors() const;

  /// The greatest common divisor, with leading coefficient 1.
  static Polynomial gcd(const Polynomial& a, const Polynomial& b);

  /// The rational c for which the polynomial is c times a primitive one with a positive leading
  /// coefficient; 0 for the zero polynomial.
  cln::cl_RA content() const;

  /// Bits of the largest coefficient, numerator and denominator.
  double bits() const;

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
  std::vector<std::pair<Polynomial, unsigned long>> monomial_factors() const;
  std::vector<std::pair<Polynomial, unsigned long>> own_factors() const;
  Polynomial moved_to(const PolynomialRing& ring, const std::vector<std::size_t>& places) const;

  const PolynomialRing* ring_;
  fmpq_mpoly_t value_;
};

/// Adds up products of polynomials, one after the other: where terms cancel, as in an identity,
/// they do so early, and the sum stays short. In between it has integer coefficients over one
/// denominator, which FLINT adds much faster than rational ones.
class SumOfProducts {
 public:
  explicit SumOfProducts(const PolynomialRing& ring);
  ~SumOfProducts();
  SumOfProducts(const SumOfProducts&) = delete;
  SumOfProducts& operator=(const SumOfProducts&) = delete;

  void add(const Polynomial& a, const Polynomial& b);

  /// The sum of what was added; nothing may be added after that.
  Polynomial finish();

 private:
  Polynomial sum_;      ///< until finished, its integer part times 1/denominator_
  Polynomial product_;  ///< of integer parts
  fmpz_t denominator_;
};

/// Collects terms in any order; like terms are added up when it is finished.
class TermCollector {
 public:
  explicit TermCollector(const PolynomialRing& ring);
  ~TermCollector();
  TermCollector(const TermCollector&) = delete;
  TermCollector& operator=(const TermCollector&) = delete;

  /// \param exponents  one for each variable of the ring.
  void add(const cln::cl_RA& coefficient, const std::vector<unsigned long>& exponents);

  /// The sum of what was added; nothing may be added after that.
  Polynomial finish();

 private:
  Polynomial sum_;  ///< while collecting, its integer part times 1/denominator_
  fmpz_t coefficient_, term_denominator_, denominator_;
};

/// The same polynomial over a ring with more variables behind its own, or without the last of them,
/// which it must not use.
Polynomial in_ring(const Polynomial& p, const PolynomialRing& ring);

}  // namespace casimir
