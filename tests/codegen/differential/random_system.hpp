#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace casimir::testing {

/// Random numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1) {}
  /// From 0 to below `bound`.
  unsigned below(unsigned bound) {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<unsigned>((state_ >> 20) % bound);
  }
  bool one_in(unsigned n) { return below(n) == 0; }
  template <class T>
  const T& of(const std::vector<T>& list) {
    return list[below(static_cast<unsigned>(list.size()))];
  }
  /// A dyadic rational of twelve bits, exact in every number type: from 1/4 to 5/4, either sign.
  double coordinate() {
    const double size = (1024. + below(4096)) / 4096;
    return one_in(3) ? -size : size;
  }

 private:
  std::uint64_t state_;
};

/// A random case file: polynomial, rational or trigonometric, by equations, canonical or on a Lie
/// algebra, with parameters, the time, definitions and names that generated code might want for
/// itself. Every function has its domain around the points of Random::coordinate.
std::string random_case(std::uint64_t seed);

}  // namespace casimir::testing
