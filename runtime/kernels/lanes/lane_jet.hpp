#pragma once

#include "runtime/kernels/lanes/jet_tables.h"
#include "runtime/kernels/lanes/lanes.hpp"

namespace casimir_kernel::lanes {

/// The Taylor series of a function of the states along a step, from those of the states. Every line
/// of the function is done for all orders before the next: unlike a right-hand side, nothing here
/// waits for a coefficient to come.
///
/// The recurrences of functions come with their lines.
template <class V>
class Jet {
  static constexpr int width = static_cast<int>(sizeof(V) / sizeof(double));
  static constexpr int stride = CASIMIR_MOST_JET_ORDER + 1;

 public:
  Jet(const casimir_jet_tables& tables, V* memory) : tables_(tables), memory_(memory) {}

  /// \return  the coefficients of the function, order + 1 of them.
  const V* expand(const casimir_lane_step& step) {
    order_ = step.order;
    for (int i = 0; i < tables_.lines; ++i) {
      const casimir_jet_line& line = tables_.line[i];
      if (line.op == CASIMIR_JET_STATE)
        copy(line, step);
      else
        work_out(line);
    }
    return row(tables_.line[tables_.lines - 1]);
  }

 private:
  V* row(const casimir_jet_line& line, int which = 0) {
    return memory_ + (line.row + which) * stride;
  }

  void copy(const casimir_jet_line& line, const casimir_lane_step& step) {
    const V* from = reinterpret_cast<const V*>(step.rows[line.a]);
    V* const to = row(line);
    for (int k = 0; k <= order_; ++k) to[k] = from[k];
  }

  /// sum over j = from .. to of u[j] v[k-j]
  static CASIMIR_INLINE V convolution(const V* u, const V* v, int k, int from, int to) {
    V even = V{}, odd = V{};
    int j = from;
    for (; j < to; j += 2) {
      even += u[j] * v[k - j];
      odd += u[j + 1] * v[k - j - 1];
    }
    if (j == to) even += u[j] * v[k - j];
    return even + odd;
  }

  /// sum over j = from .. to of j u[j] v[k-j]
  static CASIMIR_INLINE V weighted(const V* u, const V* v, int k, int from, int to) {
    V sum = V{};
    for (int j = from; j <= to; ++j) sum += (static_cast<double>(j) * u[j]) * v[k - j];
    return sum;
  }

  template <class Function>
  static V each(const V& a, Function function) {
    V result;
    for (int lane = 0; lane < width; ++lane) result[lane] = function(a[lane]);
    return result;
  }

  void work_out(const casimir_jet_line& line) {
    V* const s = row(line);
    const V* const a = line.a < 0 ? nullptr : row(tables_.line[line.a]);
    const V* const b = line.b < 0 ? a : row(tables_.line[line.b]);
    const int n = order_;
    switch (line.op) {
      case CASIMIR_JET_CONSTANT:
        for (int k = 1; k <= n; ++k) s[k] = V{};
        s[0] = all_lanes<V>(line.value);
        break;
      case CASIMIR_JET_ADD:
        for (int k = 0; k <= n; ++k) s[k] = a[k] + b[k];
        break;
      case CASIMIR_JET_SUB:
        for (int k = 0; k <= n; ++k) s[k] = a[k] - b[k];
        break;
      case CASIMIR_JET_NEG:
        for (int k = 0; k <= n; ++k) s[k] = -a[k];
        break;
      case CASIMIR_JET_MUL:
        multiply(line, s, a, b);
        break;
      case CASIMIR_JET_DIV:
        for (int k = 0; k <= n; ++k) s[k] = (a[k] - convolution(b, s, k, 1, k)) / b[0];
        break;
      default:
        work_out_function(line, s, a, b);
    }
  }

  void multiply(const casimir_jet_line& line, V* s, const V* a, const V* b) {
    const auto constant = [&](int of) { return tables_.line[of].op == CASIMIR_JET_CONSTANT; };
    if (constant(line.a)) {
      for (int k = 0; k <= order_; ++k) s[k] = a[0] * b[k];
    } else if (constant(line.b)) {
      for (int k = 0; k <= order_; ++k) s[k] = a[k] * b[0];
    } else {
      for (int k = 0; k <= order_; ++k) s[k] = convolution(a, b, k, 0, k);
    }
  }

  void work_out_function(const casimir_jet_line& line, V* s, const V* a, const V* b) {
    if (line.op == CASIMIR_JET_ATAN2) return angle(a, b, s, row(line, 1));
    if (line.op == CASIMIR_JET_FUNCTION) return follow(line, a);
    s[0] = each(a[0], [&](double x) { return __builtin_pow(x, line.value); });
    for (int k = 1; k <= order_; ++k)  // a s' = e a' s
      s[k] = (line.value * weighted(a, s, k, 1, k) - weighted(s, a, k, 1, k - 1)) /
             (static_cast<double>(k) * a[0]);
  }

  V* numbered(int row) { return memory_ + row * stride; }

  /// A function of a, by its recurrence. First the values that are functions of a: the others
  /// follow from them.
  void follow(const casimir_jet_line& line, const V* a) {
    for (int i = 0; i < line.steps; ++i)
      if (line.step[i].first) numbered(line.step[i].row)[0] = each(a[0], line.step[i].first);
    for (int i = 0; i < line.steps; ++i)
      if (!line.step[i].first) begin(line.step[i]);
    for (int k = 1; k <= order_; ++k)
      for (int i = 0; i < line.steps; ++i) extend(line.step[i], k);
  }

  void begin(const casimir_jet_step& step) {
    V* const y = numbered(step.row);
    const V* const a = numbered(step.a);
    y[0] = step.rule == CASIMIR_JET_ROOT ? each(a[0], [](double x) { return __builtin_sqrt(x); })
                                         : 1 + step.sign * a[0] * a[0];
  }

  void extend(const casimir_jet_step& step, int k) {
    V* const y = numbered(step.row);
    const V *const a = numbered(step.a), *const f = numbered(step.f);
    const double at_k = static_cast<double>(k);
    switch (step.rule) {
      case CASIMIR_JET_INTEGRAL:
        y[k] = step.sign * weighted(a, f, k, 1, k) / at_k;
        return;
      case CASIMIR_JET_QUOTIENT:
        y[k] = (step.sign * at_k * a[k] - weighted(y, f, k, 1, k - 1)) / (at_k * f[0]);
        return;
      case CASIMIR_JET_ROOT:
        y[k] = (a[k] - convolution(y, y, k, 1, k - 1)) / (2 * y[0]);
        return;
      default:
        y[k] = step.sign * convolution(a, a, k, 0, k);
    }
  }

  /// r s' = x y' - y x', r = x^2 + y^2
  void angle(const V* y, const V* x, V* s, V* r) {
    for (int lane = 0; lane < width; ++lane) s[0][lane] = __builtin_atan2(y[0][lane], x[0][lane]);
    r[0] = x[0] * x[0] + y[0] * y[0];
    for (int k = 1; k <= order_; ++k) {
      r[k] = convolution(x, x, k, 0, k) + convolution(y, y, k, 0, k);
      s[k] = (weighted(y, x, k, 1, k) - weighted(x, y, k, 1, k) - weighted(s, r, k, 1, k - 1)) /
             (static_cast<double>(k) * r[0]);
    }
  }

  const casimir_jet_tables& tables_;
  V* const memory_;
  int order_ = 0;
};

/// Between which numbers a polynomial stays for s from 0 to `taken`: its coefficients in
/// Bernstein's basis of that interval enclose it, and the first and the last are its values at the
/// ends.
template <class V>
void bernstein_range(const V* c, int order, V taken, casimir_jet_range& range) {
  V b[CASIMIR_MOST_JET_ORDER + 1];
  V power = all_lanes<V>(1), size = V{}, tail = V{};
  double binomial = 1;
  for (int k = 0; k <= order; ++k) {
    const V term = c[k] * power;
    size += absolute(term);
    if (k + 2 > order) tail += absolute(term);
    b[k] = term * (1 / binomial);
    power *= taken;
    binomial *= static_cast<double>(order - k) / (k + 1);
  }
  for (int round = 1; round <= order; ++round)
    for (int k = order; k >= round; --k) b[k] += b[k - 1];
  constexpr int width = static_cast<int>(sizeof(V) / sizeof(double));
  V least = b[0], largest = b[0];
  for (int k = 1; k <= order; ++k) {
    least = b[k] < least ? b[k] : least;
    largest = b[k] > largest ? b[k] : largest;
  }
  for (int lane = 0; lane < width; ++lane) {
    range.first[lane] = b[0][lane];
    range.last[lane] = b[order][lane];
    range.least[lane] = least[lane];
    range.largest[lane] = largest[lane];
    range.tail[lane] = size[lane] > 0 ? tail[lane] / size[lane] : 0;
  }
}

}  // namespace casimir_kernel::lanes
