// The leading terms of a Taylor step in twice the digits, for one instruction set: see
// quadratic_kernel.cpp about the names.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/taylor/double_double.hpp"
#include "runtime/kernels/taylor/leading_tables.h"
#include "runtime/module_abi.h"

namespace {

using namespace casimir_kernel;

/// The series of x' = constant + linear + quadratic up to CASIMIR_LEADING, in `blocks` registers.
template <class V, int blocks>
class Leading {
 public:
  explicit Leading(const casimir_leading_tables& tables) : tables_(tables) {}

  void add(double unit, double s, double* x, double* carry, const double* tail) {
    for (int b = 0; b < blocks; ++b)
      put(0, b, {load<V>(x + b * width), load<V>(carry + b * width)}, 1);
    // A power of two times 1 or 1/2: the products are exact.
    static_assert(CASIMIR_LEADING == 2);
    for (int b = 0; b < blocks; ++b) put(1, b, rate(0, b), unit);
    for (int b = 0; b < blocks; ++b) put(2, b, rate(1, b), unit / 2);
    const V at = all_lanes<V>(s);
    for (int b = 0; b < blocks; ++b) {
      DoubleDouble<V> sum = {load<V>(tail + b * width), V{}};
      for (int k = CASIMIR_LEADING; k > 0; --k)
        sum = DoubleDouble<V>{high_[k][b], low_[k][b]} + sum * at;
      sum = sum * at;
      const DoubleDouble<V> high = exact_sum(high_[0][b], sum.high);
      const DoubleDouble<V> next = fast_sum(high.high, high.low + (low_[0][b] + sum.low));
      __builtin_memcpy(x + b * width, &next.high, sizeof next.high);
      __builtin_memcpy(carry + b * width, &next.low, sizeof next.low);
    }
  }

 private:
  static constexpr int width = sizeof(V) / sizeof(double);

  CASIMIR_INLINE void put(int k, int b, DoubleDouble<V> value, double factor) {
    high_[k][b] = value.high * factor;
    low_[k][b] = value.low * factor;
  }

  /// Coefficient k of the states with these numbers.
  CASIMIR_INLINE DoubleDouble<V> of(int k, const long long* states) const {
    if constexpr (blocks == 1 && width > 2) {
      const Indices<width> lanes = load<Indices<width>>(states);
      return {permuted(high_[k][0], lanes), permuted(low_[k][0], lanes)};
    }
    return {collected<V>(reinterpret_cast<const double*>(high_[k]), states),
            collected<V>(reinterpret_cast<const double*>(low_[k]), states)};
  }
  static DoubleDouble<V> factor(const double* rows) {
    return {load<V>(rows), load<V>(rows + width)};
  }

  /// Coefficient k of the rates in register b.
  DoubleDouble<V> rate(int k, int b) const {
    Sum<V> sum = {};
    if (k == 0) sum.add(factor(tables_.constant + 2 * b * width));
    for (int e = tables_.linear_begin[b]; e < tables_.linear_begin[b + 1]; ++e)
      sum.add(loose_product(factor(tables_.linear_factor + 2 * e * width),
                            of(k, tables_.linear_state + e * width)));
    for (int e = tables_.product_begin[b]; e < tables_.product_begin[b + 1]; ++e) {
      const long long* const l = tables_.product_left + e * width;
      const long long* const r = tables_.product_right + e * width;
      Sum<V> inner = {};
      for (int j = 0; j <= k; ++j) inner.add(loose_product(of(j, l), of(k - j, r)));
      sum.add(loose_product(factor(tables_.product_factor + 2 * e * width),
                            static_cast<DoubleDouble<V>>(inner)));
    }
    return fast_sum(sum.high, sum.low);
  }

  const casimir_leading_tables& tables_;
  V high_[CASIMIR_LEADING + 1][blocks], low_[CASIMIR_LEADING + 1][blocks];
};

template <class V, int blocks>
void add(const casimir_leading_tables& tables, double unit, double s, double* x, double* carry,
         const double* tail) {
  if constexpr (blocks * sizeof(V) < CASIMIR_LEADING_STATES * sizeof(double)) {
    if (tables.blocks > blocks) return add<V, blocks + 1>(tables, unit, s, x, carry, tail);
  }
  Leading<V, blocks>(tables).add(unit, s, x, carry, tail);
}

}  // namespace

extern "C" void CASIMIR_JOIN(casimir_leading_, CASIMIR_TARGET)(const void* object, double,
                                                               double unit, double s, double* x,
                                                               double* carry, const double* tail) {
  const auto& tables = *static_cast<const casimir_leading_tables*>(object);
  if constexpr (kNativeWidth > 4) {
    if (tables.width == 4) return add<Lanes4, 1>(tables, unit, s, x, carry, tail);
  }
  add<Lanes<kNativeWidth>, 1>(tables, unit, s, x, carry, tail);
}
