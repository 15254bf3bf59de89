#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// What a ring of functions does for those who add generators to it; see FunctionRing.
struct GeneratorTools {
  const PolynomialRing& ring;
  std::function<Polynomial(const GiNaC::ex&)> convert;
  std::function<Polynomial(const Polynomial&)> inverse, square_root;
  /// Whether it is zero by the relations among the generators.
  std::function<bool(const Polynomial&)> vanishes;
  std::function<Polynomial(const Polynomial&, const Polynomial&)> product;
  /// The derivatives by all symbols.
  std::function<std::vector<Polynomial>(const Polynomial&)> slopes;
  /// The sine of a polynomial.
  std::function<Polynomial(const Polynomial&)> sine, cosine;
  /// The number of the generator with this tag and these arguments.
  std::function<std::optional<std::size_t>(unsigned long tag, const std::vector<Polynomial>&)>
      find{};
  /// Makes sure of room for so many generators.
  std::function<void(std::size_t)> reserve{};
  std::function<std::size_t()> count{};  ///< of generators so far
  /// The variable of a generator, also of one that is still to be made.
  std::function<Polynomial(std::size_t)> variable{};
  /// Adds one of which nothing is known but its derivatives.
  std::function<void(const GiNaC::ex& value, const Polynomial& base, unsigned long tag,
                     std::vector<Polynomial> derivatives)>
      add{};
  /// Takes it that this is positive, since the function has values there alone.
  std::function<void(const Polynomial&)> take_as_positive{};
  /// Adds the positive root of a polynomial.
  std::function<void(const GiNaC::ex& value, const Polynomial& radicand,
                     std::vector<Polynomial> derivatives)>
      add_root{};
  bool complex = false;
};

/// Tags of generators behind those of FunctionRing itself.
enum EllipticTag : unsigned long {
  kFirstElliptic = 64,
  kAmplitude = kFirstElliptic,
  kModulusSlope,  ///< the derivative by the modulus, of which nothing is known
  kFirstKind,     ///< R_F
  kSecondKind,    ///< R_D
  kThirdKind,     ///< R_J
};

/// Jacobi's functions and Carlson's integrals as polynomials of a ring of functions.
///
/// Jacobi: the amplitude a is a generator with Da = d Du, where d = sqrt(1 - k^2 sin^2 a) is the
/// positive root, since -1 < k < 1; sn = sin a, cn = cos a and dn = d, so that all relations are
/// those of sines and roots. The derivatives of a and d by the modulus are generators of
/// which nothing is known: what holds for them as unknowns holds. They have no values, so that no
/// rank is taken of them at a point, and no derivatives.
///
/// Where they have values, 1 - k^2 and the arguments of Carlson's integrals are positive.
///
/// Carlson: R = R_F(x, y, z) and one of the three R_D, D_z, are generators; the other two follow
/// from D_x + D_y + D_z = 3/sqrt(xyz) and x D_x + y D_y + z D_z = 3R (DLMF 19.21.9, homogeneity).
/// DR = -(D_x Dx + D_y Dy + D_z Dz)/6, and the derivatives of D_z are those of EllipticFunction.
/// \throws TooLarge  for what is not told apart here: equal arguments, complex numbers
Polynomial elliptic_polynomial(const GeneratorTools& tools, const GiNaC::function& f);

}  // namespace casimir
