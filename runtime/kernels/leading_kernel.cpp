// The leading terms of a Taylor step in twice the digits, for one instruction set: see
// quadratic_kernel.cpp about the names.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/double_double.hpp"
#include "runtime/kernels/leading_tables.h"
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
      put(0, b, fast_sum(load<V>(x + b * width), load<V>(carry + b * width)));
    for (int k = 0; k < CASIMIR_LEADING; ++k)
      for (int b = 0; b < blocks; ++b) put(k + 1, b, rate(k, b) * part(unit, k + 1));
    const V at = all_lanes<V>(s);
    for (int b = 0; b < blocks; ++b) {
      DoubleDouble<V> sum = {load<V>(tail + b * width), V{}};
      for (int k = CASIMIR_LEADING; k > 0; --k) sum = get(k, b) + sum * at;
      sum = sum * at;
      const DoubleDouble<V> old = get(0, b), high = exact_sum(old.high, sum.high);
      const DoubleDouble<V> next = fast_sum(high.high, high.low + (old.low + sum.low));
      __builtin_memcpy(x + b * width, &next.high, sizeof next.high);
      __builtin_memcpy(carry + b * width, &next.low, sizeof next.low);
    }
  }

 private:
  static constexpr int width = sizeof(V) / sizeof(double), room = blocks * width;

  /// unit / k, to twice the digits.
  static DoubleDouble<V> part(double unit, int k) {
    // 1 - k (1/k), where 1/k is rounded.
    static constexpr double kLost[CASIMIR_LEADING + 1] = {0, 0, 0, 0x1p-54};
    const double high = 1. / k, low = kLost[k] / k;
    return {all_lanes<V>(unit * high), all_lanes<V>(unit * low)};
  }

  void put(int k, int b, DoubleDouble<V> value) {
    __builtin_memcpy(high_[k] + b * width, &value.high, sizeof value.high);
    __builtin_memcpy(low_[k] + b * width, &value.low, sizeof value.low);
  }
  DoubleDouble<V> get(int k, int b) const {
    return {load<V>(high_[k] + b * width), load<V>(low_[k] + b * width)};
  }
  /// Coefficient k of the states with these numbers.
  DoubleDouble<V> of(int k, const long long* states) const {
    return {collected<V>(high_[k], states), collected<V>(low_[k], states)};
  }
  static DoubleDouble<V> factor(const double* rows) {
    return {load<V>(rows), load<V>(rows + width)};
  }

  /// Coefficient k of the rates in register b.
  DoubleDouble<V> rate(int k, int b) const {
    DoubleDouble<V> sum = {};
    if (k == 0) sum = factor(tables_.constant + 2 * b * width);
    for (int e = tables_.linear_begin[b]; e < tables_.linear_begin[b + 1]; ++e)
      sum = sum +
            factor(tables_.linear_factor + 2 * e * width) * of(k, tables_.linear_state + e * width);
    for (int e = tables_.product_begin[b]; e < tables_.product_begin[b + 1]; ++e) {
      const long long* const l = tables_.product_left + e * width;
      const long long* const r = tables_.product_right + e * width;
      DoubleDouble<V> inner = of(0, l) * of(k, r);
      for (int j = 1; j <= k; ++j) inner = inner + of(j, l) * of(k - j, r);
      sum = sum + factor(tables_.product_factor + 2 * e * width) * inner;
    }
    return sum;
  }

  const casimir_leading_tables& tables_;
  double high_[CASIMIR_LEADING + 1][room], low_[CASIMIR_LEADING + 1][room];
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
