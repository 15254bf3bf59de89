#pragma once

#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel {

namespace splitting {

/// Symmetric compositions of a symmetric step of order 2, each a half: the middle one last. Their
/// names are the order. Suzuki (1990) for 4, Kahan and Li (1997) for 6 and 8; see Hairer, Lubich,
/// Wanner: Geometric Numerical Integration (2006), V.3.
template <int order>
struct Scheme;

template <>
struct Scheme<4> {
  static constexpr int half = 3;
  static constexpr double gamma[half] = {0.41449077179437573714, 0.41449077179437573714,
                                         -0.65796308717750294857};
};
template <>
struct Scheme<6> {
  static constexpr int half = 5;
  static constexpr double gamma[half] = {0.39216144400731413928, 0.33259913678935943860,
                                         -0.70624617255763935981, 0.08221359629355080023,
                                         0.79854399093482996340};
};
template <>
struct Scheme<8> {
  static constexpr int half = 9;
  static constexpr double gamma[half] = {
      0.13020248308889008088, 0.56116298177510838456,  -0.38947496264484728641,
      0.15884190655515560090, -0.39590389413323757734, 0.18453964097831570709,
      0.25837438768632204729, 0.29501172360931029887,  -0.60550853383003451170};
};

/// The scheme that the error is measured with.
template <int order>
constexpr int kBelow = order - 2;

/// One step of a composition of the exact flows of the parts of a Hamiltonian.
///
/// The system has, beside its right-hand side,
///
///   static constexpr int parts;
///   static constexpr bool moves[parts][n];             whether a part changes a state
///   template <int k> static void flow(double t, const double* x, const double* p, double* dx);
///                                                      what the flow of part k adds in the time t
///
/// A Poisson map of order 6 or 8 that is symmetric: it keeps every Casimir function to rounding and
/// the Hamiltonian to a bounded error for exponentially long times. Each flow is summed with a
/// carry, which goes over from step to step. The error is estimated by the step of two orders less
/// from the same state; where the step is constant that is left out. The dense output takes a
/// shorter step of the same method. An adaptive step spoils the long-time behaviour.
template <class System, int order>
struct Step {
  static constexpr int n = System::n, parts = System::parts;
  static constexpr int power = order + 1;

  double next[n], next_carry[n];  // the state at the end of the step
  double f[n], f1[n];
  double error = 0;
  const casimir_run* run = nullptr;
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    System::rhs(run->t_begin, start, run->parameters, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  /// The flow of part k for the time h.
  template <int k>
  static inline __attribute__((always_inline)) void follow(double h, const double* p, double* x,
                                                           double* carry) {
    double dx[n];
    System::template flow<k>(h, x, p, dx);
    CASIMIR_UNROLL
    for (int i = 0; i < n; ++i)
      if (System::moves[k][i]) add_carried(x[i], carry[i], dx[i]);
  }

  /// The symmetric step without part k - 1 and those before: half of k, what is inside, half of k.
  template <int k>
  static inline __attribute__((always_inline)) void inner(double h, const double* p, double* x,
                                                          double* carry) {
    if constexpr (k + 1 == parts) {
      follow<k>(h, p, x, carry);
    } else if constexpr (k < parts) {
      follow<k>(h / 2, p, x, carry);
      inner<k + 1>(h, p, x, carry);
      follow<k>(h / 2, p, x, carry);
    }
  }

  /// A whole step; neighbouring halves of part 0 are one.
  template <int of_order>
  __attribute__((noinline)) static void compose(double h, const double* p, double* x,
                                                double* carry) {
    using S = Scheme<of_order>;
    constexpr int stages = 2 * S::half - 1;
    double before = 0;
    for (int j = 0; j < stages; ++j) {
      const double piece = h * S::gamma[j < S::half ? j : stages - 1 - j];
      follow<0>((before + piece) / 2, p, x, carry);
      inner<1>(piece, p, x, carry);
      before = piece;
    }
    follow<0>(before / 2, p, x, carry);
  }

  Trial attempt(double t, const double* x, const double* carry, double h, bool adaptive) {
    double other[n], other_carry[n];
    for (int i = 0; i < n; ++i) {
      next[i] = other[i] = x[i];
      next_carry[i] = other_carry[i] = carry[i];
    }
    compose<order>(h, run->parameters, next, next_carry);
    evaluations += 2 * Scheme<order>::half - 1;
    if (!all_finite<n>(next)) return Trial::not_finite;
    error = 0;
    if (!adaptive) return hold(t + h);
    compose<kBelow<order>>(h, run->parameters, other, other_carry);
    evaluations += 2 * Scheme<kBelow<order>>::half - 1;
    const double all = larger(1e-3 * largest<n>(x), kSmallest);
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      const double size = larger(magnitude(x[i]), magnitude(next[i]));
      const double gap = magnitude((next[i] - other[i]) + (next_carry[i] - other_carry[i]));
      // A NaN here must not look like a small error.
      const double part = gap / allowed_error(run, size);
      error = part <= error ? error : part;
      worst = larger(worst, gap / larger(size, all));
    }
    // The gap is of order - 1: what the step itself misses is smaller by two powers more.
    const double lower = rough_root(worst, order - 1);
    error *= lower * lower;
    return hold(t + h);
  }

  Trial hold(double t1) {
    System::rhs(t1, next, run->parameters, f1);
    ++evaluations;
    return Trial::done;
  }

  bool arrive(double, const double*) { return all_finite<n>(f1); }

  void accept() {
    for (int i = 0; i < n; ++i) f[i] = f1[i];
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    const Step* self = static_cast<const Step*>(step->data);
    double carry[n] = {};
    for (int i = 0; i < n; ++i) at[i] = step->x0[i];
    compose<order>(t - step->t0, self->run->parameters, at, carry);
  }
};

template <class System, int order>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System, order>>(run, x, out);
}

}  // namespace splitting

}  // namespace casimir_kernel
