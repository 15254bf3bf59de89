#pragma once

#include <string>
#include <utility>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"
#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/functions/function_ring.hpp"

namespace casimir::discrete {

/// A rational number times a product of powers of irreducible polynomials, none of which is a
/// multiple of another.
struct FactoredQuotient {
  cln::cl_RA number = 1;
  std::vector<std::pair<Polynomial, int>> powers;

  /// \param base  irreducible
  void multiply(const Polynomial& base, int exponent);
  /// By a power of a polynomial that is not zero.
  void multiply_factors(const Polynomial& p, int exponent);
  /// 0 where the polynomial is none of the bases.
  int exponent_of(const Polynomial& base) const;

  std::string text(const FunctionRing& ring) const;
  GiNaC::ex value(const FunctionRing& ring) const;
};

/// The exponents of all bases and primes in quotients, without their signs: one row for each of
/// them, one column for each quotient. A product of powers of the quotients is 1 or -1 where these
/// rows are orthogonal to the exponents.
/// \throws TooLarge  where a number was not factored
RationalMatrix exponent_rows(const std::vector<FactoredQuotient>& quotients);

}  // namespace casimir::discrete
