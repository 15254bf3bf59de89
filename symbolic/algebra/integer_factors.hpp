#pragma once

#include <cln/integer.h>

#include <optional>
#include <utility>
#include <vector>

namespace casimir {

/// Primes with their exponents.
using PrimeFactors = std::vector<std::pair<cln::cl_I, unsigned long>>;

/// The prime factors of a positive integer in ascending order, by FLINT. Empty where they were not
/// found: what is left without primes below 32,749 has more than 200 bits, or more than 96 and is
/// neither a prime nor a power; and, once in thousands, where elliptic curves miss two large
/// primes.
std::optional<PrimeFactors> prime_factors(const cln::cl_I& n);

}  // namespace casimir
