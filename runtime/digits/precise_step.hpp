#pragma once

#include <optional>
#include <vector>

#include "runtime/digits/big_float.hpp"

namespace casimir {

using LongSeries = std::vector<BigFloat>;

/// How many bits coefficients have, from order 0 down to the last. See `log2_step`.
struct Envelope {
  double bits = 0;   ///< of the result
  double slack = 0;  ///< by how many bits a term may be larger than the envelope
};

/// log2 of the longest step h for which the terms a_k h^k of the solution decay from the size of
/// the state at k = 0 to 2^-bits of it at the last k, none of them above a straight line in the
/// logarithm by more than the slack. So no sum cancels, and a coefficient of order k needs only
/// bits (1 - k / order) binary digits. +infinity where the solution is constant.
/// \param states  coefficients [state][k].
/// \param others  series of the program that may converge in a smaller disk than the states'; all
///                but the last coefficient.
double log2_step(const std::vector<LongSeries>& states,
                 const std::vector<const LongSeries*>& others, const Envelope& envelope);

/// The distance h to the singularity that the series meets first, if that is on the real line:
/// exact for powers (1 - t/h)^p by the ratio of coefficients, whatever p is (Darboux's method;
/// Chang & Corliss, J. Inst. Maths Applics 25, 349, 1980).
struct Singularity {
  BigFloat distance;   ///< negative: in the past
  double log2_spread;  ///< of two estimates from different orders
};
std::optional<Singularity> nearest_singularity(const std::vector<LongSeries>& states);

}  // namespace casimir
