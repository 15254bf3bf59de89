#pragma once

#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/one_step/dop853_tableau.hpp"

namespace casimir_kernel {

namespace dop853 {

/// One step of the method of Dormand and Prince of order 8(5,3).
///
/// 12 evaluations a step; the derivative at the end is the first stage of the next step. The error
/// estimate combines two embedded solutions so that it behaves like h^8 (Hairer, Norsett, Wanner I,
/// II.10). Explicit, not for stiff systems; keeps no invariant but linear ones. The dense output is
/// of order 7 and costs three evaluations once per step where it is asked for.
template <class System>
struct Step {
  static constexpr int n = System::n;
  static constexpr int power = 8;

  double x[n] = {}, f[n] = {};
  double k2[n] = {}, k3[n] = {}, k4[n] = {}, k5[n] = {}, k6[n] = {}, k7[n] = {}, k8[n] = {},
         k9[n] = {}, k10[n] = {}, k11[n] = {}, k12[n] = {}, k13[n] = {};
  double increment[n] = {};
  double r4[n], r5[n], r6[n], r7[n];  // of the dense output
  double h = 0, error = 0;
  const double* p = nullptr;
  const casimir_run* run = nullptr;
  bool extended = false;  // r4 to r7 belong to this step
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    p = asked->parameters;
    System::rhs(run->t_begin, start, p, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  Trial attempt(double t, const double* start, const double*, double size, bool) {
    h = size;
    extended = false;
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) x[i] = start[i];
    find_stages(t);
    find_increment_and_error();
    return all_finite<n>(increment) ? Trial::done : Trial::not_finite;
  }

  /// The right-hand sides k2 to k12 of a step of h from x.
  void find_stages(double t) {
    const double* k1 = f;
    double y[n];
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a21 * k1[i]);
    System::rhs(t + c2 * h, y, p, k2);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a31 * k1[i] + a32 * k2[i]);
    System::rhs(t + c3 * h, y, p, k3);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a41 * k1[i] + a43 * k3[i]);
    System::rhs(t + c4 * h, y, p, k4);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a51 * k1[i] + a53 * k3[i] + a54 * k4[i]);
    System::rhs(t + c5 * h, y, p, k5);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a61 * k1[i] + a64 * k4[i] + a65 * k5[i]);
    System::rhs(t + h * (1. / 3), y, p, k6);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a71 * k1[i] + a74 * k4[i] + a75 * k5[i] + a76 * k6[i]);
    System::rhs(t + 0.25 * h, y, p, k7);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a81 * k1[i] + a84 * k4[i] + a85 * k5[i] + a86 * k6[i] + a87 * k7[i]);
    System::rhs(t + h * (4. / 13), y, p, k8);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a91 * k1[i] + a94 * k4[i] + a95 * k5[i] + a96 * k6[i] + a97 * k7[i] +
                         a98 * k8[i]);
    System::rhs(t + h * (127. / 195), y, p, k9);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a10_1 * k1[i] + a10_4 * k4[i] + a10_5 * k5[i] + a10_6 * k6[i] +
                         a10_7 * k7[i] + a10_8 * k8[i] + a10_9 * k9[i]);
    System::rhs(t + 0.6 * h, y, p, k10);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a11_1 * k1[i] + a11_4 * k4[i] + a11_5 * k5[i] + a11_6 * k6[i] +
                         a11_7 * k7[i] + a11_8 * k8[i] + a11_9 * k9[i] + a11_10 * k10[i]);
    System::rhs(t + h * (6. / 7), y, p, k11);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] +
             h * (a12_1 * k1[i] + a12_4 * k4[i] + a12_5 * k5[i] + a12_6 * k6[i] + a12_7 * k7[i] +
                  a12_8 * k8[i] + a12_9 * k9[i] + a12_10 * k10[i] + a12_11 * k11[i]);
    System::rhs(t + h, y, p, k12);
    evaluations += 11;
  }

  /// The step's increment, and its error as a part of what is allowed.
  void find_increment_and_error() {
    const double* k1 = f;
    double y[n];
    double squares5 = 0, squares3 = 0;
    for (int i = 0; i < n; ++i) {
      y[i] = b1_rest * k1[i] + b9_rest * k9[i] + b12_rest * k12[i] + b1 * k1[i] + b6 * k6[i] +
             b7 * k7[i] + b8 * k8[i] + b9 * k9[i] + b10 * k10[i] + b11 * k11[i] + b12 * k12[i];
      increment[i] = h * y[i];
    }
    for (int i = 0; i < n; ++i) {
      const double fifth = e5_1 * k1[i] + e5_6 * k6[i] + e5_7 * k7[i] + e5_8 * k8[i] +
                           e5_9 * k9[i] + e5_10 * k10[i] + e5_11 * k11[i] + e5_12 * k12[i];
      const double third = e3_1 * k1[i] + e3_6 * k6[i] + e3_7 * k7[i] + e3_8 * k8[i] +
                           e3_9 * k9[i] + e3_10 * k10[i] + e3_11 * k11[i] + e3_12 * k12[i];
      const double unit =
          1 / allowed_error(run, larger(magnitude(x[i]), magnitude(x[i] + increment[i])));
      squares5 += (fifth * unit) * (fifth * unit);
      squares3 += (third * unit) * (third * unit);
    }
    const double mix = squares5 + 0.01 * squares3;
    error = mix > 0 ? magnitude(h) * squares5 / __builtin_sqrt(n * mix) : mix;
  }

  bool arrive(double t1, const double* x1) {
    System::rhs(t1, x1, p, k13);
    ++evaluations;
    return all_finite<n>(k13);
  }

  void accept() {
    for (int i = 0; i < n; ++i) f[i] = k13[i];
  }

  __attribute__((cold, noinline)) void extend(const casimir_step* step) {
    const double t = step->t0;
    const double* k1 = f;
    double y[n];
    double k14[n] = {}, k15[n] = {}, k16[n] = {};
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a14_1 * k1[i] + a14_7 * k7[i] + a14_8 * k8[i] + a14_9 * k9[i] +
                         a14_10 * k10[i] + a14_11 * k11[i] + a14_12 * k12[i] + a14_13 * k13[i]);
    System::rhs(t + 0.1 * h, y, p, k14);
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a15_1 * k1[i] + a15_6 * k6[i] + a15_7 * k7[i] + a15_8 * k8[i] +
                         a15_11 * k11[i] + a15_12 * k12[i] + a15_13 * k13[i] + a15_14 * k14[i]);
    System::rhs(t + 0.2 * h, y, p, k15);
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a16_1 * k1[i] + a16_6 * k6[i] + a16_7 * k7[i] + a16_8 * k8[i] +
                         a16_9 * k9[i] + a16_13 * k13[i] + a16_14 * k14[i] + a16_15 * k15[i]);
    System::rhs(t + h * (7. / 9), y, p, k16);
    evaluations += 3;
    for (int i = 0; i < n; ++i) {
      r4[i] = h * (d4_1 * k1[i] + d4_6 * k6[i] + d4_7 * k7[i] + d4_8 * k8[i] + d4_9 * k9[i] +
                   d4_10 * k10[i] + d4_11 * k11[i] + d4_12 * k12[i] + d4_13 * k13[i] +
                   d4_14 * k14[i] + d4_15 * k15[i] + d4_16 * k16[i]);
      r5[i] = h * (d5_1 * k1[i] + d5_6 * k6[i] + d5_7 * k7[i] + d5_8 * k8[i] + d5_9 * k9[i] +
                   d5_10 * k10[i] + d5_11 * k11[i] + d5_12 * k12[i] + d5_13 * k13[i] +
                   d5_14 * k14[i] + d5_15 * k15[i] + d5_16 * k16[i]);
      r6[i] = h * (d6_1 * k1[i] + d6_6 * k6[i] + d6_7 * k7[i] + d6_8 * k8[i] + d6_9 * k9[i] +
                   d6_10 * k10[i] + d6_11 * k11[i] + d6_12 * k12[i] + d6_13 * k13[i] +
                   d6_14 * k14[i] + d6_15 * k15[i] + d6_16 * k16[i]);
      r7[i] = h * (d7_1 * k1[i] + d7_6 * k6[i] + d7_7 * k7[i] + d7_8 * k8[i] + d7_9 * k9[i] +
                   d7_10 * k10[i] + d7_11 * k11[i] + d7_12 * k12[i] + d7_13 * k13[i] +
                   d7_14 * k14[i] + d7_15 * k15[i] + d7_16 * k16[i]);
    }
    extended = true;
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    Step* self = static_cast<Step*>(const_cast<void*>(step->data));
    if (!self->extended) self->extend(step);
    const double s = (t - step->t0) / self->h, r = 1 - s;
    for (int i = 0; i < n; ++i) {
      const double chord = step->x1[i] - step->x0[i];
      const double bend = self->h * self->f[i] - chord;
      const double twist = chord - self->h * self->k13[i] - bend;
      const double inner = self->r4[i] + s * (self->r5[i] + r * (self->r6[i] + s * self->r7[i]));
      at[i] = step->x0[i] + s * (chord + r * (bend + s * (twist + r * inner)));
    }
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System>>(run, x, out);
}

}  // namespace dop853

}  // namespace casimir_kernel
