// The Taylor coefficients of any right-hand side, from the tables of its program, for one
// instruction set: see quadratic_kernel.cpp about the names.
#define CASIMIR_JOIN_(a, b) a##b
#define CASIMIR_JOIN(a, b) CASIMIR_JOIN_(a, b)
#define casimir_kernel CASIMIR_JOIN(casimir_kernel_, CASIMIR_TARGET)

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/taylor/program_tables.h"

namespace casimir_kernel {
namespace {

constexpr int kWidth = kNativeWidth;
using V = Lanes<kWidth>;

CASIMIR_INLINE void store(double* to, V v) { __builtin_memcpy(to, &v, sizeof v); }

/// One group of operations at one order.
class Group {
 public:
  Group(const casimir_program& of, const casimir_group& group, int order)
      : g_(group), rows_(of.rows), k_(order), place_(of.place) {}

  void extend() const {
    switch (g_.kind) {
      case CASIMIR_GROUP_ADD:
        for (int i = 0; i < g_.count; ++i) out()[i] = a(i) + b(i);
        break;
      case CASIMIR_GROUP_SUB:
        for (int i = 0; i < g_.count; ++i) out()[i] = a(i) - b(i);
        break;
      case CASIMIR_GROUP_NEG:
        for (int i = 0; i < g_.count; ++i) out()[i] = -a(i);
        break;
      case CASIMIR_GROUP_SCALE:
        for (int i = 0; i < g_.count; ++i) out()[i] = g_.constant[i] * a(i);
        break;
      case CASIMIR_GROUP_SHRINK:
        for (int i = 0; i < g_.count; ++i) out()[i] = a(i) / g_.constant[i];
        break;
      case CASIMIR_GROUP_MUL:
        keep(0, g_.a);
        keep(1, g_.b);
        each([&](int lane) { return convolution(0, 1, 0, k_, lane); });
        break;
      default:
        extend_function();
    }
  }

 private:
  double a(int i) const { return place_[g_.a[i]]; }
  double b(int i) const { return place_[g_.b[i]]; }
  double* out() const { return place_ + g_.target; }

  /// Coefficient k of series h, for all operations.
  double* series(int h, int k) const { return g_.history + (h * rows_ + k) * g_.padded; }
  V at(int h, int k, int lane) const { return load<V>(series(h, k) + lane); }

  /// The operands become coefficient k of series h.
  void keep(int h, const int* from) const {
    double* const to = series(h, k_);
    for (int i = 0; i < g_.count; ++i) to[i] = place_[from[i]];
  }
  /// The same times k: coefficients of t times the derivative.
  void keep_weighted(int h, const double* from) const {
    double* const to = series(h, k_);
    for (int i = 0; i < g_.count; ++i) to[i] = k_ * from[i];
  }

  template <class Value>
  CASIMIR_INLINE void each(Value value) const {
    for (int lane = 0; lane < g_.padded; lane += kWidth) store(out() + lane, value(lane));
  }

  /// sum over j = from..to of u_j v_{k-j}. Four sums, so that none waits for another.
  CASIMIR_INLINE V convolution(int u, int v, int from, int to, int lane) const {
    const double* left = series(u, from) + lane;
    const double* right = series(v, k_ - from) + lane;
    const int step = g_.padded;
    V sum[4] = {};
    int j = from;
    for (; j + 3 <= to; j += 4) {
      CASIMIR_UNROLL
      for (int q = 0; q < 4; ++q) sum[q] += load<V>(left + q * step) * load<V>(right - q * step);
      left += 4 * step;
      right -= 4 * step;
    }
    for (; j <= to; ++j, left += step, right -= step) sum[0] += load<V>(left) * load<V>(right);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }

  /// The first coefficients are the values themselves.
  template <class Value>
  void begin(double* to, Value value) const {
    for (int i = 0; i < g_.count; ++i) to[i] = value(i);
  }

  void extend_function() const {
    switch (g_.kind) {
      case CASIMIR_GROUP_DIV:
        return divide();
      case CASIMIR_GROUP_SQRT:
        return root();
      case CASIMIR_GROUP_POW:
        return power();
      case CASIMIR_GROUP_EXP:
        return exponential();
      case CASIMIR_GROUP_LOG:
        return logarithm();
      default:
        return sine_and_cosine();
    }
  }

  /// y = a / b: b_0 y_k = a_k - sum over j = 1..k of b_j y_{k-j}
  void divide() const {
    keep(0, g_.b);
    double* const y = series(1, k_);
    if (k_ == 0) {
      begin(y, [&](int i) { return a(i) / b(i); });
    } else {
      each([&](int lane) { return convolution(0, 1, 1, k_, lane); });
      const double* const first = series(0, 0);
      for (int i = 0; i < g_.count; ++i) y[i] = (a(i) - out()[i]) / first[i];
    }
    publish(y, out());
  }

  /// y y = a: 2 y_0 y_k = a_k - sum over j = 1..k-1 of y_j y_{k-j}
  void root() const {
    double* const y = series(0, k_);
    if (k_ == 0) {
      begin(y, [&](int i) { return __builtin_sqrt(a(i)); });
    } else {
      each([&](int lane) { return convolution(0, 0, 1, k_ - 1, lane); });
      const double* const first = series(0, 0);
      for (int i = 0; i < g_.count; ++i) y[i] = (a(i) - out()[i]) / (2 * first[i]);
    }
    publish(y, out());
  }

  /// y = a^e, a y' = e y a': k a_0 y_k = sum over j = 1..k of e j a_j y_{k-j} - sum over
  /// j = 1..k-1 of j y_j a_{k-j}. The series are a, y, and both times k.
  void power() const {
    double* const y = series(1, k_);
    keep(0, g_.a);
    keep_weighted(2, series(0, k_));
    if (k_ == 0) {
      begin(y, [&](int i) { return __builtin_pow(a(i), g_.constant[i]); });
    } else {
      const double* const first = series(0, 0);
      each([&](int lane) { return convolution(2, 1, 1, k_, lane); });
      for (int i = 0; i < g_.count; ++i) y[i] = g_.constant[i] * out()[i];
      each([&](int lane) { return convolution(3, 0, 1, k_ - 1, lane); });
      for (int i = 0; i < g_.count; ++i) y[i] = (y[i] - out()[i]) / (k_ * first[i]);
    }
    keep_weighted(3, y);
    publish(y, out());
  }

  /// y' = y a': k y_k = sum over j = 1..k of j a_j y_{k-j}
  void exponential() const {
    double* const y = series(1, k_);
    keep(0, g_.a);
    keep_weighted(0, series(0, k_));
    if (k_ == 0) {
      begin(y, [&](int i) { return __builtin_exp(a(i)); });
    } else {
      each([&](int lane) { return convolution(0, 1, 1, k_, lane); });
      for (int i = 0; i < g_.count; ++i) y[i] = out()[i] / k_;
    }
    publish(y, out());
  }

  /// a y' = a': k a_0 y_k = k a_k - sum over j = 1..k-1 of j y_j a_{k-j}
  void logarithm() const {
    keep(0, g_.a);
    double* const y = series(2, k_);
    if (k_ == 0) {
      begin(y, [&](int i) { return __builtin_log(a(i)); });
    } else {
      each([&](int lane) { return convolution(1, 0, 1, k_ - 1, lane); });
      const double* const first = series(0, 0);
      for (int i = 0; i < g_.count; ++i) y[i] = (k_ * a(i) - out()[i]) / (k_ * first[i]);
    }
    keep_weighted(1, y);
    publish(y, out());
  }

  /// s' = c a', c' = -s a'
  void sine_and_cosine() const {
    double *const s = series(1, k_), *const c = series(2, k_);
    double* const cosines = out() + g_.padded;
    keep(0, g_.a);
    keep_weighted(0, series(0, k_));
    if (k_ == 0) {
      begin(s, [&](int i) { return __builtin_sin(a(i)); });
      begin(c, [&](int i) { return __builtin_cos(a(i)); });
    } else {
      for (int lane = 0; lane < g_.padded; lane += kWidth) {
        store(out() + lane, convolution(0, 2, 1, k_, lane));
        store(cosines + lane, convolution(0, 1, 1, k_, lane));
      }
      for (int i = 0; i < g_.count; ++i) s[i] = out()[i] / k_;
      for (int i = 0; i < g_.count; ++i) c[i] = -cosines[i] / k_;
    }
    publish(s, out());
    publish(c, cosines);
  }

  void publish(const double* y, double* to) const {
    for (int i = 0; i < g_.count; ++i) to[i] = y[i];
  }

  const casimir_group& g_;
  const int rows_, k_;
  double* const place_;
};

void expand(const casimir_program& of, double t, double unit, double* rows) {
  for (int k = 0; k < of.order; ++k) {
    const double* const x = rows + k * of.stride;
    double* const next = rows + (k + 1) * of.stride;
    for (int i = 0; i < of.states; ++i) of.place[i] = x[i];
    of.place[of.time] = k == 0 ? t : k == 1 ? unit : 0;
    if (k < 2)
      for (int i = 0; i < of.constants; ++i)
        of.place[of.first_constant + i] = k == 0 ? of.constant[i] : 0;
    for (int i = 0; i < of.groups; ++i) Group(of, of.group[i], k).extend();
    for (int i = 0; i < of.states; ++i) next[i] = unit * (of.place[of.output[i]] / (k + 1));
  }
}

}  // namespace
}  // namespace casimir_kernel

/// \param rows  coefficients of the states: row 0 is the state, rows 1 to `order` are written.
extern "C" void CASIMIR_JOIN(casimir_program_, CASIMIR_TARGET)(const casimir_program* of, double t,
                                                               double unit, double* rows) {
  casimir_kernel::expand(*of, t, unit, rows);
}
