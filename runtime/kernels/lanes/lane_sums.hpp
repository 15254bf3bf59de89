#pragma once

#include "runtime/kernels/lanes/lanes.hpp"

namespace casimir_kernel::lanes {

/// total + carry becomes total + carry + increment, in all lanes: `casimir_kernel::add_carried` for
/// registers.
template <class V>
CASIMIR_INLINE void add(V& total, V& carry, V increment) {
  const V y = increment + carry;
  const V sum = total + y;
  const V part = sum - total;
  carry = (total - (sum - part)) + (y - part);
  total = sum;
}

}  // namespace casimir_kernel::lanes
