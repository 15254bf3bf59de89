#pragma once

#include <cstdint>
#include <vector>

#include "symbolic/search/system.hpp"

namespace casimir::search {

struct Fields;

/// The finest grading of a system's functions that their relations and its fields have: two
/// monomials are of one part where their exponents differ by whole multiples of differences of
/// exponents within a relation or within a field. A field takes parts to parts, so that the parts
/// of a function that it annihilates are some themselves. This finds every weight, parity and
/// torus.
class Grading {
 public:
  Grading(const System& system, const Fields& fields);

  /// Equal for monomials of one part.
  /// \param exponents  one for each of the fields' places
  std::vector<std::int64_t> part_of(const std::uint8_t* exponents) const;

  /// A basis of the weights by which all monomials of a part have one weight: whole numbers without
  /// a common divisor, one for each of the fields' places.
  std::vector<std::vector<std::int64_t>> weights() const;

 private:
  using Exponents = std::vector<std::int64_t>;
  void relate(const Polynomial& p);
  void relate_field(const std::vector<std::size_t>& places, const std::vector<Polynomial>& rates);
  void insert(Exponents difference);
  Exponents exponents_of(const std::vector<unsigned long>& powers) const;

  const System& system_;
  std::vector<std::size_t> places_;
  std::vector<bool> used_;       ///< by the fields and the relations
  std::vector<Exponents> rows_;  ///< an echelon form of the lattice, by ascending pivots
  bool is_trivial_ = false;      ///< all is one part: numbers became too large
};

}  // namespace casimir::search
