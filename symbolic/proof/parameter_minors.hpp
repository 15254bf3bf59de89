#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// Fraction-free elimination (Bareiss), up to the sign; empty where it grows long.
/// \param most_terms  of an entry on the way
std::optional<Polynomial> short_determinant(std::vector<std::vector<Polynomial>> matrix,
                                            const PolynomialRing& ring,
                                            std::size_t most_terms = 40);

/// The indices, and these with one of them changed to another below `end`: rows or columns of
/// minors.
std::vector<std::vector<std::size_t>> with_one_changed(const std::vector<std::size_t>& indices,
                                                       std::size_t end);

/// A polynomial modulo a prime, for many evaluations: what is not zero there is not zero.
class MinorModulo {
 public:
  /// \throws std::domain_error  where a coefficient has no value modulo the prime
  explicit MinorModulo(const Polynomial& p);

  /// \param point  a value for each variable of the ring
  bool is_nonzero_at(const std::vector<std::uint64_t>& point) const { return value_at(point) != 0; }
  std::uint64_t value_at(const std::vector<std::uint64_t>& point) const;

 private:
  struct Term {
    std::uint64_t number;
    std::vector<std::pair<std::size_t, unsigned long>> powers;
  };
  std::vector<Term> terms_;
};

/// A matrix of polynomials modulo the same prime.
class MatrixModulo {
 public:
  explicit MatrixModulo(const std::vector<std::vector<Polynomial>>& rows);

  /// No larger than the rank over the rational numbers; 0 where some number has no residue.
  /// \param point  of each symbol of a ring without other functions
  std::size_t rank_at(const std::vector<GiNaC::ex>& point) const;

 private:
  std::vector<std::vector<MinorModulo>> rows_;  ///< none where a coefficient has no residue
};

}  // namespace casimir
