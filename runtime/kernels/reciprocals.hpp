#pragma once

namespace casimir_kernel::taylor {

/// 1/k, for the recurrences.
struct Reciprocals {
  double of[32] = {};
  constexpr Reciprocals() {
    for (int k = 1; k < 32; ++k) of[k] = 1. / k;
  }
};
inline constexpr Reciprocals reciprocal;

}  // namespace casimir_kernel::taylor
