#pragma once

#include "runtime/kernels/one_step/map_step.hpp"

namespace casimir_kernel {

namespace kahan {

/// One step of Kahan's map x1 = x + h (1 - (h/2) f'(x))^-1 f(x) of a quadratic field f that does
/// not depend on the time.
///
/// It is the bilinear rule (x1 - x)/h = F(x, x1) with F symmetric and F(x, x) = f(x): symmetric, of
/// order 2, a birational map of degree n + 1 at most; for cubic Hamiltonians and a constant bracket
/// it keeps an energy and a density (Celledoni, McLachlan, Owren, Quispel 2013). A step is one
/// linear system, by elimination in place up to kOwn states, by the caller's solver above.
template <class System>
struct Map {
  static constexpr int n = System::n;
  static constexpr int kOwn = 24;

  bool begin(const casimir_run*) { return true; }

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

  static bool move(const casimir_run* run, double t, const double* x, const double* field, double h,
                   double* moved) {
    double matrix[n * n];
    System::jacobian(t, x, run->parameters, matrix);
    for (int k = 0; k < n * n; ++k) matrix[k] = (k % (n + 1) == 0 ? 1. : 0.) - 0.5 * h * matrix[k];
    for (int i = 0; i < n; ++i) moved[i] = h * field[i];
    if constexpr (n <= kOwn) {
      return eliminate(matrix, moved);
    } else {
      if (!run->factor || run->factor(run->solver, 0, n, matrix)) return false;
      run->solve(run->solver, 0, moved);
      return true;
    }
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, MapStep<System, Map<System>>>(run, x, out);
}

}  // namespace kahan

}  // namespace casimir_kernel
