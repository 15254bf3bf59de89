#pragma once

#include <optional>
#include <random>
#include <vector>

#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// The different roots of sum_k coefficients[k] x^k modulo a prime.
std::vector<Residue> different_roots(const std::vector<Residue>& coefficients,
                                     const Modulus& modulus);

/// A root of sum_k coefficients[k] x^k modulo a prime, drawn among those there are; empty for none.
std::optional<Residue> random_root(const std::vector<Residue>& coefficients, const Modulus& modulus,
                                   std::mt19937_64& random);

/// A number with that square, either of the two; empty where there is none.
std::optional<Residue> random_square_root(Residue square, const Modulus& modulus,
                                          std::mt19937_64& random);

}  // namespace casimir::search
