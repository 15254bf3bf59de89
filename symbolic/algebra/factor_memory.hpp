#pragma once

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

using Factors = std::vector<std::pair<Polynomial, unsigned long>>;

/// The factors that were found in a ring, which owns this: a proof asks for those of the same few
/// polynomials again and again, and each time FLINT would find them anew. Several threads may ask
/// for those of one ring.
class FactorMemory {
 public:
  /// \param p  of the ring
  /// \return  what `keep` was given for this polynomial, or what follows from it
  std::optional<Factors> of(const Polynomial& p) const;

  /// \param p  of the ring
  /// \param factors  irreducible, the constant one first; they are known to be so from then on
  void keep(const Polynomial& p, const Factors& factors);

 private:
  struct Entry {
    Polynomial whole;
    Factors factors;
  };
  const Entry* find(const Polynomial& p) const;

  mutable std::mutex guard_;
  std::vector<Entry> entries_;
};

}  // namespace casimir
