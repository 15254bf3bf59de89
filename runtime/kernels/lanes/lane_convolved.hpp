#pragma once

#include "runtime/kernels/lanes/lane_march.hpp"
#include "runtime/kernels/taylor/convolved.hpp"

namespace casimir_kernel::lanes {

/// A function of numbers, in each lane. Arguments are registers or numbers.
template <class V>
CASIMIR_INLINE double lane_of(const V& a, int lane) {
  return a[lane];
}
CASIMIR_INLINE double lane_of(double a, int) { return a; }

template <class V, class Function, class... Arguments>
CASIMIR_INLINE V each(Function function, const Arguments&... arguments) {
  V result;
  for (int lane = 0; lane < width_of<V>; ++lane)
    result[lane] = function(lane_of(arguments, lane)...);
  return result;
}

/// Storage for the recurrences of a straight-line program, one trajectory in each lane.
/// \tparam rows  series of which sums of products are formed, and `sums` of these.
template <int the_states, int parameters, int rows, int sums>
struct Convolved {
  using V = Lanes<kNativeWidth>;
  static constexpr int most = 24;  // the highest order
  static constexpr int states = the_states, room = the_states;
  static constexpr bool smooth = false, fixed_states = true;

  int order = most;

  V* row(int i) { return c[i]; }
  void enter(int lane, const double* numbers) {
    for (int i = 0; i < parameters; ++i) p[i][lane] = numbers[i];
  }

 protected:
  V c[states][most + 1] = {};
  V p[parameters > 0 ? parameters : 1] = {};
  V begun_[states] = {};  // the rates of the last `begin`
  V series_[rows > 0 ? rows : 1][most] = {};
  V sum_[sums > 0 ? sums : 1] = {};

  /// sum of l[j] r[k-j], j = 1 .. k-1.
  static CASIMIR_INLINE V inner(const V* l, const V* r, int k) {
    V even = V{}, odd = V{};
    int j = 1;
    for (; j + 1 < k; j += 2) {
      even += l[j] * r[k - j];
      odd += l[j + 1] * r[k - j - 1];
    }
    if (j < k) even += l[j] * r[k - j];
    return even + odd;
  }
};

}  // namespace casimir_kernel::lanes
