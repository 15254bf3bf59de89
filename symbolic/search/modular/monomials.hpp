#pragma once

#include <cstdint>
#include <vector>

namespace casimir::search {

/// The monomials that an ansatz is made of, by ascending degree.
class Monomials {
 public:
  explicit Monomials(std::size_t variables) : variables_(variables) {}

  std::size_t size() const { return degrees_.size(); }
  std::size_t variables() const { return variables_; }
  /// One exponent for each variable.
  const std::uint8_t* operator[](std::size_t i) const { return exponents_.data() + i * variables_; }
  int degree(std::size_t i) const { return degrees_[i]; }  ///< weighted
  void add(const std::vector<std::uint8_t>& exponents, int degree);

 private:
  std::size_t variables_;
  std::vector<std::uint8_t> exponents_;
  std::vector<int> degrees_;
};

/// How many monomials there are up to that weighted degree; a float, as it may be huge.
double count_monomials(const std::vector<int>& weights, int degree);

/// All of them. Weights are positive, and degree/weight is below 256.
Monomials all_monomials(const std::vector<int>& weights, int degree);

/// The products of generators up to a degree, without those that use only the first `old` of them:
/// exponents for each generator. The constant 1 is among them where `old` is 0.
std::vector<std::vector<int>> products_up_to(const std::vector<int>& degrees, int degree,
                                             std::size_t old);

/// Keys of monomials: the key of a product is the sum of the keys. Distinct for distinct monomials
/// of a degree up to `degree` where they fit into a word, else with a probability next to 1. Two
/// with the same key merge two equations into their sum, which can add solutions but never hide
/// one; and solutions are proved.
std::vector<std::uint64_t> monomial_keys(std::size_t variables, int degree);

}  // namespace casimir::search
