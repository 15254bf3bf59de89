#pragma once

#include "runtime/kernels/inline.hpp"

namespace casimir_kernel {

/// total + carry becomes total + carry + increment; carry keeps what rounding would lose (Knuth's
/// exact sum), so that the error of many small steps does not grow with their number. For a number,
/// or each lane of a register.
template <class Number>
CASIMIR_INLINE void add_carried(Number& total, Number& carry, Number increment) {
  const Number y = increment + carry;
  const Number sum = total + y;
  const Number part = sum - total;
  carry = (total - (sum - part)) + (y - part);
  total = sum;
}

}  // namespace casimir_kernel
