#include "symbolic/search/modular/modular.hpp"

#include <cln/integer_ring.h>
#include <flint/ulong_extras.h>

namespace casimir::search {

Modulus Modulus::nth(std::size_t i) {
  // Steps of some hundreds: primes are about 20 apart, and a few thousand are never used up.
  mp_limb_t below = (mp_limb_t{1} << kBits) - 1024 * i;
  while (n_is_prime(below) == 0) --below;
  return Modulus(static_cast<Residue>(below));
}

Residue Modulus::power(Residue a, std::uint64_t exponent) const {
  Residue result = 1;
  for (; exponent != 0; exponent >>= 1) {
    if ((exponent & 1) != 0) result = multiply(result, a);
    a = multiply(a, a);
  }
  return result;
}

std::optional<Residue> Modulus::reduce(const cln::cl_RA& number) const {
  const cln::cl_I prime(static_cast<unsigned long>(prime_));
  const auto residue = [&](const cln::cl_I& n) {
    return static_cast<Residue>(cln::cl_I_to_ulong(cln::mod(n, prime)));
  };
  const Residue bottom = residue(cln::denominator(number));
  if (bottom == 0) return std::nullopt;
  const Residue top = residue(cln::numerator(number));
  return bottom == 1 ? top : multiply(top, inverse(bottom));
}

std::optional<cln::cl_RA> rational_from(const cln::cl_I& residue, const cln::cl_I& modulus) {
  const cln::cl_I bound = cln::isqrt(cln::floor1(modulus, 2));
  cln::cl_I r0 = modulus, r1 = cln::mod(residue, modulus), s0 = 0, s1 = 1;
  while (r1 > bound) {
    const cln::cl_I quotient = cln::floor1(r0, r1);
    const cln::cl_I r2 = r0 - quotient * r1;
    const cln::cl_I s2 = s0 - quotient * s1;
    r0 = r1, r1 = r2, s0 = s1, s1 = s2;
  }
  if (cln::zerop(s1) || cln::abs(s1) > bound || cln::gcd(r1, s1) != 1) return std::nullopt;
  return cln::cl_RA(r1) / s1;
}

cln::cl_I chinese_remainder(const cln::cl_I& a, const cln::cl_I& modulus, Residue b,
                            const Modulus& other) {
  const Residue own = *other.reduce(cln::cl_RA(a));
  const Residue step = other.inverse(*other.reduce(cln::cl_RA(modulus)));
  const Residue times = other.multiply(other.add(b, other.negative(own)), step);
  return a + modulus * cln::cl_I(static_cast<unsigned long>(times));
}

}  // namespace casimir::search
