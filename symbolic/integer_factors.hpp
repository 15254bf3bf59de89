#pragma once

#include <cln/integer.h>

#include <optional>
#include <utility>
#include <vector>

namespace casimir {

/// Primes with their exponents.
using PrimeFactors = std::vector<std::pair<cln::cl_I, unsigned long>>;

/// The prime factors of a positive integer, by FLINT. Empty where that might take for ever: what is
/// left without primes below 32,749 has more than 112 bits and is no prime, or more than 200.
std::optional<PrimeFactors> prime_factors(const cln::cl_I& n);

}  // namespace casimir
