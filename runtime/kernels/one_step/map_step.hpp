#pragma once

#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel {

/// One step by a map x -> x1 of order 2 that is symmetric: the steps of Kahan and of Moser and
/// Veselov.
///
/// The error is estimated as for the implicit midpoint rule, which differs by h^3: by the defect
/// h |p'(1) - f(x1)| of the straight line from x to x1. Dense output takes a shorter step. An
/// adaptive step spoils the long-time behaviour; then prefer a fixed step.
/// \tparam Map  has
///
///   bool begin(const casimir_run*);      whether there is such a map
///   bool move(const casimir_run*, double t, const double* x, const double* f, double h,
///             double* moved) const;      what it adds to x in the time h, where the right-hand
///                                        side is f; false if no next state is found
template <class System, class Map>
struct MapStep {
  static constexpr int n = System::n;
  static constexpr int power = 2;

  Map map;
  double increment[n], f[n], f1[n];
  double error = 0;
  const casimir_run* run = nullptr;
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    System::rhs(run->t_begin, start, run->parameters, f);
    ++evaluations;
    return all_finite<n>(f) && map.begin(run);
  }

  Trial attempt(double t, const double* x, const double*, double h, bool adaptive) {
    if (!map.move(run, t, x, f, h, increment)) return Trial::not_solved;
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
    const MapStep* self = static_cast<const MapStep*>(step->data);
    double field[n], moved[n];
    System::rhs(step->t0, step->x0, self->run->parameters, field);
    const bool solved = self->map.move(self->run, step->t0, step->x0, field, t - step->t0, moved);
    for (int i = 0; i < n; ++i) at[i] = solved ? step->x0[i] + moved[i] : __builtin_nan("");
  }
};

}  // namespace casimir_kernel
