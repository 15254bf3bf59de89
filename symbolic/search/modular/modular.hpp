#pragma once

#include <cln/integer.h>
#include <cln/rational.h>

#include <cstdint>
#include <optional>
#include <random>

namespace casimir::search {

/// Arithmetic modulo a prime below 2^29: 64 products of residues fit into a 64-bit sum, so that
/// inner loops add without reducing.
class Modulus {
 public:
  using Residue = std::uint32_t;
  static constexpr int kBits = 29;
  static constexpr std::size_t kProductsInASum = 64;

  explicit Modulus(Residue prime) : prime_(prime), reciprocal_(~std::uint64_t{0} / prime) {}

  /// The i-th of the primes below 2^29, the largest first.
  static Modulus nth(std::size_t i);

  Residue prime() const { return prime_; }

  /// x modulo the prime, for any x.
  Residue reduce(std::uint64_t x) const {
    __extension__ using Wide = unsigned __int128;
    const auto quotient = static_cast<std::uint64_t>((Wide{x} * reciprocal_) >> 64);
    const std::uint64_t rest = x - quotient * prime_;
    return static_cast<Residue>(rest >= prime_ ? rest - prime_ : rest);
  }
  Residue add(Residue a, Residue b) const {
    const Residue sum = a + b;
    return sum >= prime_ ? sum - prime_ : sum;
  }
  Residue negative(Residue a) const { return a == 0 ? 0 : prime_ - a; }
  Residue multiply(Residue a, Residue b) const { return reduce(std::uint64_t{a} * b); }
  Residue power(Residue a, std::uint64_t exponent) const;
  Residue inverse(Residue a) const { return power(a, prime_ - 2); }  ///< of a != 0

  /// Empty where the prime divides the denominator.
  std::optional<Residue> reduce(const cln::cl_RA& number) const;

  Residue random(std::mt19937_64& generator) const { return reduce(generator()); }

 private:
  Residue prime_;
  std::uint64_t reciprocal_;
};

using Residue = Modulus::Residue;

/// The fraction n/d = residue modulo `modulus` with |n|, d at most sqrt(modulus/2), if there is
/// one.
std::optional<cln::cl_RA> rational_from(const cln::cl_I& residue, const cln::cl_I& modulus);

/// The number that is `a` modulo `modulus` and `b` modulo the prime of `other`.
cln::cl_I chinese_remainder(const cln::cl_I& a, const cln::cl_I& modulus, Residue b,
                            const Modulus& other);

}  // namespace casimir::search
