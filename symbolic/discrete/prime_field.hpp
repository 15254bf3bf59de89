#pragma once

#include <cln/rational.h>
#include <flint/nmod_vec.h>

#include <cstdint>
#include <optional>
#include <random>

namespace casimir::discrete {

/// A residue modulo the prime 2^61 - 1. That a polynomial of degree d that is not zero vanishes at
/// a random point has the probability d/2^61 there.
using Element = mp_limb_t;

inline constexpr Element kPrime = (Element{1} << 61) - 1;

/// Another one, below 2^61, that is 1 modulo 720720: roots of unity up to the order 16 are in its
/// field, and with them the roots of -1, 2, 3, 5, 7, 11 and 13. Numbers that are algebraic in such
/// ways are where points are looked for.
inline constexpr Element kSplittingPrime = 2305843009213423681ULL;

/// FLINT's arithmetic modulo a prime.
class PrimeField {
 public:
  explicit PrimeField(Element prime = kPrime) { nmod_init(&modulus_, prime); }
  Element prime() const { return modulus_.n; }

  Element add(Element a, Element b) const { return nmod_add(a, b, modulus_); }
  Element subtract(Element a, Element b) const { return nmod_sub(a, b, modulus_); }
  Element multiply(Element a, Element b) const { return nmod_mul(a, b, modulus_); }
  Element inverse(Element a) const { return nmod_inv(a, modulus_); }  ///< of a != 0
  Element power(Element a, std::uint64_t n) const { return nmod_pow_ui(a, n, modulus_); }
  Element random(std::mt19937_64& generator) const { return generator() % prime(); }

  /// Empty where the prime divides the denominator.
  std::optional<Element> reduce(const cln::cl_RA& number) const;

 private:
  nmod_t modulus_;
};

}  // namespace casimir::discrete
