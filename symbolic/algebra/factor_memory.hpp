#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

using Factors = std::vector<std::pair<Polynomial, unsigned long>>;

/// The factors that were found in a ring: a proof asks for those of the same few polynomials again
/// and again, and each time FLINT would find them anew. They are forgotten with their ring.
/// Several threads may use rings of their own.
class FactorMemory {
 public:
  /// \return  what `keep` was given for this polynomial, or what follows from it
  static std::optional<Factors> of(const Polynomial& p);

  /// \param factors  irreducible, the constant one first; they are known to be so from then on
  static void keep(const Polynomial& p, const Factors& factors);

  /// Where the ring ends.
  static void forget(const PolynomialRing& ring);
};

}  // namespace casimir
