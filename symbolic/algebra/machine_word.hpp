#pragma once

#include <cln/integer.h>

#include "symbolic/error.hpp"

namespace casimir {

/// |n| as a machine word, for exponents and the orders of roots. CLN's own conversions, and
/// GiNaC's, keep the low bits of what does not fit and say nothing.
/// \throws TooLarge  beyond 2^40, so that sums and products with small numbers fit as well.
inline unsigned long machine_word(const cln::cl_I& n) {
  constexpr std::size_t kMostBits = 40;
  if (cln::integer_length(cln::abs(n)) > kMostBits)
    throw TooLarge("an exponent, or the order of a root, has more than twelve digits");
  return cln::cl_I_to_ulong(cln::abs(n));
}

}  // namespace casimir
