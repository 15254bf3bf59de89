#pragma once

#include <cstddef>
#include <optional>

#include "runtime/program.hpp"

namespace casimir::codegen {

/// The same function where exponentials are beyond all doubles though what they stand in is not: in
/// logarithms, divisors and roots. Every value is carried as v exp(m), and a sum a exp(m) + b
/// exp(n) as (a exp(m - k) + b exp(n - k)) exp(k) with k = max(m, n). So log(1 + exp(u)) becomes
/// max(u, 0) + log(exp(-max(u, 0)) + exp(min(u, 0))), and 1/(1 + exp(u)) underflows to 0.
///
/// The maxima are moduli, at which steps end, and near which nothing is lost: the identity holds
/// for any k. Sinh loses digits near 0, so this is for what cannot be had otherwise.
/// \param states  the number of inputs that are states; the last one is the time.
/// \return  nothing where no logarithm, divisor or root holds an exponential.
std::optional<Program> with_scaled_exponentials(const Program& program, std::size_t states);

}  // namespace casimir::codegen
