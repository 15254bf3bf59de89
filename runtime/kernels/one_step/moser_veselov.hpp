#pragma once

#include "runtime/kernels/one_step/map_step.hpp"

namespace casimir_kernel {

namespace moser_veselov {

/// One step of the map of Moser and Veselov of a free rigid body dm/dt = m x w, m = I w.
///
/// The system has, beside its right-hand side,
///
///   static void moments(const double* p, double* values);   I_1, I_2, I_3, and what the step is
///                                                           multiplied with
///
/// The rotation that solves h m = R^T J - J R (vectors as skew matrices, I = tr J - J) has the
/// quaternion (sqrt(1 - q^2), q), for which the equation reads
///
///   m = (2/h) (sqrt(1 - q^2) I q + q x I q),   and   m1 = (2/h) (sqrt(1 - q^2) I q - q x I q)
///
/// is the next one, which is m turned by R: the map keeps m^2, the energy and the bracket, is
/// symmetric and of order 2 (Moser, Veselov: Commun. Math. Phys. 139 (1991) 217; McLachlan, Zanna:
/// Found. Comput. Math. 5 (2005) 87). q is found by Newton's method from the implicit midpoint
/// rule's first iterate. There is no q for a step that is too long.
template <class System>
struct Map {
  static_assert(System::n == 3);
  static constexpr int n = 3;
  static constexpr int kMostIterations = 30;

  double values[4];

  bool begin(const casimir_run* run) {
    System::moments(run->parameters, values);
    return all_finite<4>(values);
  }

  static void cross(const double* a, const double* b, double* c) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
  }

  static double dot(const double* a, const double* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  /// One step of Newton's method for sqrt(1 - q^2) I q + q x I q = half; `change` is what it adds.
  bool improve(const double* half, double* q, double* change) const {
    const double scalar = __builtin_sqrt(1 - dot(q, q));
    double spin[n], turned[n], columns[n][n], defect[n];
    for (int i = 0; i < n; ++i) spin[i] = values[i] * q[i];
    cross(q, spin, turned);
    for (int i = 0; i < n; ++i) defect[i] = half[i] - scalar * spin[i] - turned[i];
    // The derivative by q_j: (scalar I - spin q^T/scalar) e_j + e_j x spin + I_j q x e_j.
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) columns[j][i] = -spin[i] * q[j] / scalar;
      const int k = (j + 1) % n, l = (j + 2) % n;
      columns[j][j] += scalar * values[j];
      columns[j][k] += values[j] * q[l] - spin[l];
      columns[j][l] += spin[k] - values[j] * q[k];
    }
    double minors[n][n];
    for (int j = 0; j < n; ++j) cross(columns[(j + 1) % n], columns[(j + 2) % n], minors[j]);
    const double determinant = dot(columns[0], minors[0]);
    for (int j = 0; j < n; ++j) {
      change[j] = dot(minors[j], defect) / determinant;
      q[j] += change[j];
    }
    return dot(q, q) < 1;
  }

  bool move(const casimir_run*, double, const double* x, const double* field, double h,
            double* moved) const {
    const double scaled = values[3] * h;
    double half[n], q[n], change[n], turned[n], spin[n];
    for (int i = 0; i < n; ++i) {
      half[i] = scaled * x[i] / 2;
      q[i] = scaled * (x[i] + h * field[i] / 2) / (2 * values[i]);
    }
    // After a step that changes so little, the square of that is below rounding.
    constexpr double kSettled = 0x1p-60;
    for (int k = 0; k < kMostIterations; ++k) {
      if (!improve(half, q, change)) return false;
      if (!(dot(change, change) > kSettled * dot(q, q))) {
        for (int i = 0; i < n; ++i) spin[i] = values[i] * q[i];
        cross(q, spin, turned);
        for (int i = 0; i < n; ++i) moved[i] = scaled == 0 ? 0 : -4 * turned[i] / scaled;
        return true;
      }
    }
    return false;
  }
};

template <class System>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, MapStep<System, Map<System>>>(run, x, out);
}

}  // namespace moser_veselov

}  // namespace casimir_kernel
