#pragma once

#include <cln/integer.h>

#include <optional>
#include <utility>
#include <vector>

namespace casimir {

/// The prime factors of a positive integer with their exponents, by FLINT; empty for integers of
/// more than 200 bits, which might take for ever.
std::optional<std::vector<std::pair<cln::cl_I, unsigned long>>> prime_factors(const cln::cl_I& n);

}  // namespace casimir
