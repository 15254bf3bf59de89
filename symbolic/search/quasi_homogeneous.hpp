#pragma once

#include <optional>
#include <string>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir::search {

/// Weights g_i = numerators[i] / denominator of the variables for which x_i -> s^(g_i) x_i and
/// t -> t/s keep the leading terms of a field: those of weight g_i + 1. All others have less.
struct Weights {
  std::vector<int> numerators;
  int denominator = 1;
};

/// The weight of a term of the i-th rate beyond what leading terms have, in units of
/// 1/denominator: 0 for a leading term, negative for others; positive would not be allowed.
int excess(const Weights& weights, std::size_t i, const std::vector<unsigned long>& exponents);

/// Weights for which the most terms are leading; empty if there are none with small numbers.
/// \param field  rates of the first variables of the ring
/// \param names  of these; those that differ in a last digit only, as M1 and M2, are tried with
///               one weight first
std::optional<Weights> find_weights(const std::vector<Polynomial>& field,
                                    const std::vector<std::string>& names);

}  // namespace casimir::search
