#pragma once

#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A space of vectors modulo a prime that grows.
class Span {
 public:
  explicit Span(const Modulus& modulus) : modulus_(modulus) {}

  /// Adds a vector; false if the space contains it already.
  bool insert(std::vector<Residue> vector);
  bool contains(std::vector<Residue> vector) const { return !reduce(vector); }
  std::size_t dimension() const { return rows_.size(); }

 private:
  /// Leaves the vector with zeros at the pivots; false if nothing is left.
  bool reduce(std::vector<Residue>& vector) const;

  const Modulus& modulus_;
  std::vector<std::vector<Residue>> rows_;
  std::vector<std::size_t> pivots_;
};

}  // namespace casimir::search
