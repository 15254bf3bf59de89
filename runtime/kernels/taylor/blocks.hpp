#pragma once

#include "runtime/kernels/lanes/lanes.hpp"

namespace casimir_kernel::taylor {

/// How many registers hold a state: a constant, or for 0 a number at run time, up to `most`.
template <int fixed, int most>
struct Blocks {
  static constexpr int blocks = fixed, room = fixed;
  explicit Blocks(int) {}
};
template <int most>
struct Blocks<0, most> {
  const int blocks;
  static constexpr int room = most;
  explicit Blocks(int count) : blocks(count) {}
};

/// Coefficients one after the other, each in as many registers as hold a state.
template <class V, int fixed>
struct Rows {
  V* at;
  int stride;
  CASIMIR_INLINE V* operator[](int k) const { return at + k * (fixed > 0 ? fixed : stride); }
};

}  // namespace casimir_kernel::taylor
