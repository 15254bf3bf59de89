#pragma once

#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel {

/// The explicit Runge-Kutta pair of order 5(4) of Dormand and Prince, with the continuous extension
/// of order 4 that costs no evaluation. Stage 7 is the derivative at the end of the step. The tests
/// check every order condition.
///
/// Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I (2nd ed. 1993), II.5 table
/// 5.2, II.6 (6.12); the extension as in their code DOPRI5.
namespace dopri5 {

constexpr double a21 = 1. / 5;
constexpr double a31 = 3. / 40, a32 = 9. / 40;
constexpr double a41 = 44. / 45, a42 = -56. / 15, a43 = 32. / 9;
constexpr double a51 = 19372. / 6561, a52 = -25360. / 2187, a53 = 64448. / 6561, a54 = -212. / 729;
constexpr double a61 = 9017. / 3168, a62 = -355. / 33, a63 = 46732. / 5247, a64 = 49. / 176,
                 a65 = -5103. / 18656;
constexpr double c2 = 1. / 5, c3 = 3. / 10, c4 = 4. / 5, c5 = 8. / 9;
constexpr double b1 = 35. / 384, b3 = 500. / 1113, b4 = 125. / 192, b5 = -2187. / 6784,
                 b6 = 11. / 84;
// The result less that of order 4.
constexpr double e1 = 71. / 57600, e3 = -71. / 16695, e4 = 71. / 1920, e5 = -17253. / 339200,
                 e6 = 22. / 525, e7 = -1. / 40;
constexpr double d1 = -12715105075. / 11282082432, d3 = 87487479700. / 32700410799,
                 d4 = -10690763975. / 1880347072, d5 = 701980252875. / 199316789632,
                 d6 = -1453857185. / 822651844, d7 = 69997945. / 29380423;

/// One step of that pair. 6 evaluations a step; keeps no invariant but linear ones, and is not for
/// stiff systems. The cheapest method here for two to five digits.
template <class System>
struct Step {
  static constexpr int n = System::n;
  static constexpr int power = 5;

  double f[n] = {}, increment[n] = {};
  double k2[n] = {}, k3[n] = {}, k4[n] = {}, k5[n] = {}, k6[n] = {}, k7[n] = {};
  double h = 0, error = 0;
  const double* p = nullptr;
  const casimir_run* run = nullptr;
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    p = asked->parameters;
    System::rhs(run->t_begin, start, p, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  Trial attempt(double t, const double* x, const double*, double size, bool) {
    const double* k1 = f;
    double y[n];
    h = size;
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a21 * k1[i]);
    System::rhs(t + c2 * h, y, p, k2);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a31 * k1[i] + a32 * k2[i]);
    System::rhs(t + c3 * h, y, p, k3);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) y[i] = x[i] + h * (a41 * k1[i] + a42 * k2[i] + a43 * k3[i]);
    System::rhs(t + c4 * h, y, p, k4);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a51 * k1[i] + a52 * k2[i] + a53 * k3[i] + a54 * k4[i]);
    System::rhs(t + c5 * h, y, p, k5);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      y[i] = x[i] + h * (a61 * k1[i] + a62 * k2[i] + a63 * k3[i] + a64 * k4[i] + a65 * k5[i]);
    System::rhs(t + h, y, p, k6);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i) {
      increment[i] = h * (b1 * k1[i] + b3 * k3[i] + b4 * k4[i] + b5 * k5[i] + b6 * k6[i]);
      y[i] = x[i] + increment[i];
    }
    System::rhs(t + h, y, p, k7);
    evaluations += 6;
    double squares = 0;
    for (int i = 0; i < n; ++i) {
      const double defect =
          h * (e1 * k1[i] + e3 * k3[i] + e4 * k4[i] + e5 * k5[i] + e6 * k6[i] + e7 * k7[i]);
      const double part = defect / allowed_error(run, larger(magnitude(x[i]), magnitude(y[i])));
      squares += part * part;
    }
    error = __builtin_sqrt(squares / n);
    return all_finite<n>(increment) ? Trial::done : Trial::not_finite;
  }

  /// The derivative at the end is known but where a projection has moved it.
  bool arrive(double t1, const double* x1) {
    if (run->project) {
      System::rhs(t1, x1, p, k7);
      ++evaluations;
    }
    return all_finite<n>(k7);
  }

  void accept() {
    for (int i = 0; i < n; ++i) f[i] = k7[i];
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    const Step* self = static_cast<const Step*>(step->data);
    const double h = self->h, s = (t - step->t0) / h, r = 1 - s;
    for (int i = 0; i < n; ++i) {
      const double chord = step->x1[i] - step->x0[i];
      const double bend = h * self->f[i] - chord;
      const double twist = chord - h * self->k7[i] - bend;
      const double inner = h * (d1 * self->f[i] + d3 * self->k3[i] + d4 * self->k4[i] +
                                d5 * self->k5[i] + d6 * self->k6[i] + d7 * self->k7[i]);
      at[i] = step->x0[i] + s * (chord + r * (bend + s * (twist + r * inner)));
    }
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System>>(run, x, out);
}

}  // namespace dopri5

}  // namespace casimir_kernel
