#pragma once

#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel {

namespace kahan {

/// One step of Kahan's map x1 = x + h (1 - (h/2) f'(x))^-1 f(x) of a quadratic field f that does
/// not depend on the time.
///
/// It is the bilinear rule (x1 - x)/h = F(x, x1) with F symmetric and F(x, x) = f(x): symmetric, of
/// order 2, a birational map of degree n + 1 at most; for cubic Hamiltonians and a constant bracket
/// it keeps an energy and a density (Celledoni, McLachlan, Owren, Quispel 2013). A step is one
/// linear system, by elimination in place up to kOwn states, by the caller's solver above.
///
/// The error is estimated as for the implicit midpoint rule, which differs by h^3: by the defect
/// h |p'(1) - f(x1)| of the straight line from x to x1. Dense output takes a shorter step. An
/// adaptive step spoils the long-time behaviour; then prefer a fixed step.
template <class System>
struct Step {
  static constexpr int n = System::n;
  static constexpr int power = 2;
  static constexpr int kOwn = 24;

  double increment[n], f[n], f1[n];
  double error = 0;
  const casimir_run* run = nullptr;
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    System::rhs(run->t_begin, start, run->parameters, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  /// Gauss' elimination with pivots by rows; the matrix by columns is lost. False if it is
  /// singular.
  static bool eliminate(double* a, double* b) {
    for (int k = 0; k < n; ++k) {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (magnitude(a[k * n + i]) > magnitude(a[k * n + pivot])) pivot = i;
      if (!(magnitude(a[k * n + pivot]) > 0)) return false;
      if (pivot != k) {
        for (int j = k; j < n; ++j) {
          const double kept = a[j * n + k];
          a[j * n + k] = a[j * n + pivot];
          a[j * n + pivot] = kept;
        }
        const double kept = b[k];
        b[k] = b[pivot];
        b[pivot] = kept;
      }
      const double inverse = 1 / a[k * n + k];
      for (int i = k + 1; i < n; ++i) {
        const double factor = a[k * n + i] * inverse;
        for (int j = k + 1; j < n; ++j) a[j * n + i] -= factor * a[j * n + k];
        b[i] -= factor * b[k];
      }
    }
    for (int k = n - 1; k >= 0; --k) {
      b[k] /= a[k * n + k];
      for (int i = 0; i < k; ++i) b[i] -= a[k * n + i] * b[k];
    }
    return true;
  }

  /// What the map adds to x in the time h; f is the field at x.
  static bool map(const casimir_run* run, double t, const double* x, const double* field, double h,
                  double* move) {
    double matrix[n * n];
    System::jacobian(t, x, run->parameters, matrix);
    for (int k = 0; k < n * n; ++k) matrix[k] = (k % (n + 1) == 0 ? 1. : 0.) - 0.5 * h * matrix[k];
    for (int i = 0; i < n; ++i) move[i] = h * field[i];
    if constexpr (n <= kOwn) {
      return eliminate(matrix, move);
    } else {
      if (!run->factor || run->factor(run->solver, 0, n, matrix)) return false;
      run->solve(run->solver, 0, move);
      return true;
    }
  }

  Trial attempt(double t, const double* x, const double*, double h, bool adaptive) {
    if (!map(run, t, x, f, h, increment)) return Trial::not_solved;
    ++jacobians;
    if (!all_finite<n>(increment)) return Trial::not_finite;
    double x1[n];
    for (int i = 0; i < n; ++i) x1[i] = x[i] + increment[i];
    System::rhs(t + h, x1, run->parameters, f1);
    ++evaluations;
    error = 0;
    if (!adaptive) return Trial::done;
    for (int i = 0; i < n; ++i) {
      const double reach = larger(magnitude(x[i]), magnitude(x1[i]));
      const double part = magnitude(increment[i] - h * f1[i]) / allowed_error(run, reach);
      // A NaN here must not look like a small error.
      error = part <= error ? error : part;
    }
    return Trial::done;
  }

  bool arrive(double, const double*) { return all_finite<n>(f1); }

  void accept() {
    for (int i = 0; i < n; ++i) f[i] = f1[i];
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    const Step* self = static_cast<const Step*>(step->data);
    double field[n], move[n];
    System::rhs(step->t0, step->x0, self->run->parameters, field);
    const bool solved = map(self->run, step->t0, step->x0, field, t - step->t0, move);
    for (int i = 0; i < n; ++i) at[i] = solved ? step->x0[i] + move[i] : __builtin_nan("");
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System>>(run, x, out);
}

}  // namespace kahan

}  // namespace casimir_kernel
