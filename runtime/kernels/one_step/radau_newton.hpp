#pragma once

#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/one_step/radau_tableau.hpp"

namespace casimir_kernel {

namespace radau {

/// Watches the corrections of an iteration: until they are below what the tolerance asks for, or
/// no more than rounding errors. Each component is judged by its own size, so that small ones keep
/// their relative accuracy.
template <int n, int s>
struct Watch {
  static constexpr int kSweeps = 16;
  static constexpr double kFlattered = 0.02;
  double best[n], share, noise;
  const casimir_run* run;
  const double* x;
  double level = 0;    // the largest correction in units of what would be good enough
  double contraction;  // of the last sweeps; negative: unknown
  int sweep = 0, bad = 0;

  /// \param part  the corrections may be this part of the tolerance; 0: rounding alone counts
  /// \param known  how an iteration with the same matrix contracted, or negative
  /// \param most  corrections below it, relative to the state, may be rounding errors
  Watch(const casimir_run* asked, const double* start, double part, double known, double most)
      : share(part), noise(most), run(asked), x(start), contraction(known) {
    for (int i = 0; i < n; ++i) best[i] = __builtin_inf();
  }

  enum Answer { go_on, solved, hopeless };

  /// The sweep has added delta (stages of n numbers) and come to z.
  Answer see(const double* delta, const double* z) {
    const double last = level, all = 1e-2 * largest<n>(x);
    bool stuck = true, rounding = true;
    level = 0;
    for (int i = 0; i < n; ++i) {
      double own = magnitude(x[i]), change = 0;
      for (int j = 0; j < s; ++j) {
        own = larger(own, magnitude(z[j * n + i]));
        change = larger(change, magnitude(delta[j * n + i]));
      }
      const double enough = larger(share * allowed_error(run, own), 2 * kEpsilon * own);
      level = larger(level, change / larger(enough, kSmallest));
      if (change > enough) {
        const bool small = change <= noise * larger(own, all);
        rounding = rounding && small;
        stuck = stuck && small && change > 0.5 * best[i];
      }
      best[i] = change < best[i] ? change : best[i];
    }
    ++sweep;
    if (level <= 1) return solved;
    if (sweep > 1) {
      const double rate = level / last;
      if (sweep == 2 || level > 100) contraction = rate;
      if (stuck) return solved;
      if (will_do(rate)) return solved;
      if (rate >= 1) bad += rate > 2 ? 2 : 1;
      if (bad > 1 && !rounding) return hopeless;
      if (!rounding && too_slow(rate)) return hopeless;
    } else if (contraction >= 0 && will_do(contraction)) {
      return solved;
    }
    return sweep < kSweeps ? go_on : rounding ? solved : hopeless;
  }

 private:
  /// Whether what further sweeps would add is small enough. The rates of the first sweeps flatter:
  /// where a stiff direction turns within the step, the corrections along it are followed by larger
  /// ones across.
  bool will_do(double rate) const {
    return rate < 1 && larger(rate, kFlattered) * level <= 1 - rate;
  }
  bool too_slow(double rate) const {
    double then = level;
    for (int k = sweep; k < kSweeps; ++k) then *= rate;
    return sweep > 2 && then > 1;
  }
};

/// The Jacobian at a state, n*n by columns: the generated one, or else by differences of f, the
/// derivative there, as far as the state changes in the time h.
template <class System>
__attribute__((noinline)) void differentiate(const casimir_run* run, double t, const double* x,
                                             const double* f, double h, double* J,
                                             unsigned long long* evaluations) {
  constexpr int n = System::n;
  if constexpr (requires(double* a) { System::jacobian(0., a, a, a); }) {
    (void)f, (void)h, (void)evaluations;
    System::jacobian(t, x, run->parameters, J);
    // Quotients of numbers beyond all doubles, such as the derivative of 1/cosh(x)^2 far out: what
    // is solved is the equations themselves, and a part of J that is missing slows that down at
    // most.
    for (int i = 0; i < n * n; ++i)
      if (!__builtin_isfinite(J[i])) J[i] = 0;
  } else {
    double y[n];
    const double all = 1e-5 * larger(largest<n>(x), magnitude(h) * largest<n>(f));
    for (int i = 0; i < n; ++i) y[i] = x[i];
    for (int d = 0; d < n; ++d) {
      y[d] += 0x1p-26 * larger(magnitude(x[d]), all) * (f[d] * h < 0 ? -1 : 1);
      System::rhs(t, y, run->parameters, J + d * n);
      for (int c = 0; c < n; ++c) J[d * n + c] = (J[d * n + c] - f[c]) / (y[d] - x[d]);
      y[d] = x[d];
    }
    *evaluations += n;
  }
}

/// The equations z_i = h sum_j a_ij f(t + c_j h, x + z_j) for the increments z of the stages.
///
/// The cheap way is simplified Newton iteration: one Jacobian J for all stages, and the matrix A^-1
/// in its real normal form, by which the system of s n equations falls apart into one of n and some
/// of 2n (Hairer, Wanner II, IV.8; Butcher, BIT 16 (1976) 237). Where a stiff direction turns
/// within the step, its corrections are spoilt in proportion to the stiffness; then Newton's method
/// itself with the Jacobians at the stages.
template <class System, int s>
struct Newton {
  static constexpr int n = System::n, size = n * s, pairs = (s - 1) / 2;
  static constexpr int kFull = CASIMIR_MATRICES - 1;  // the number of the matrix of all stages
  static constexpr int kLargest = 256;                // its size at most
  // Newton's method itself stagnates for nothing but rounding, which h times a stiff rate enlarges.
  static constexpr double kNoise = 0x1p-26;
  using Table = Tableau<s>;

  /// Factorises gamma - h J and the matrix of each pair, as the caller's number `first` and the
  /// next. False if one of them is singular.
  __attribute__((noinline)) static bool factor(const casimir_run* run, int first, double h,
                                               const double* J) {
    double small[n * n], twice[4 * n * n];
    for (int k = 0; k < n * n; ++k) small[k] = (k % (n + 1) == 0 ? Table::gamma : 0) - h * J[k];
    bool regular = run->factor(run->solver, first, n, small) == 0;
    for (int q = 0; q < pairs && regular; ++q) {
      for (int d = 0; d < n; ++d)
        for (int c = 0; c < n; ++c) {
          const double one = c == d ? 1 : 0;
          const double entry = one * Table::alpha[q] - h * J[d * n + c];
          twice[2 * n * d + c] = twice[2 * n * (n + d) + n + c] = entry;
          twice[2 * n * d + n + c] = -one * Table::beta[q];
          twice[2 * n * (n + d) + c] = one * Table::beta[q];
        }
      regular = run->factor(run->solver, first + 1 + q, 2 * n, twice) == 0;
    }
    return regular;
  }

  /// Turns the residuals of the equations into corrections.
  static void correct(const casimir_run* run, int first, double* r) {
    double w[size];
    multiply(Table::forth, r, w);
    run->solve(run->solver, first, w);
    for (int q = 0; q < pairs; ++q) run->solve(run->solver, first + 1 + q, w + (1 + 2 * q) * n);
    multiply(Table::back, w, r);
  }

  /// Where and how to iterate.
  struct Task {
    const casimir_run* run;
    double t;
    const double *x, *carry;  // n numbers, and what their rounding lost
    double h, share;          // the step, and the part of the tolerance as `Watch` has it
    unsigned long long *evaluations, *jacobians;
  };

  /// The stages, their derivatives, and the residuals of the equations. False if not finite.
  static bool evaluate(const Task& of, const double* z, double* y, double* f, double* r) {
    for (int j = 0; j < s; ++j) {
      double* stage = y + j * n;
      for (int i = 0; i < n; ++i) stage[i] = of.x[i] + (of.carry[i] + z[j * n + i]);
      System::rhs(of.t + Table::c[j] * of.h, stage, of.run->parameters, f + j * n);
    }
    *of.evaluations += s;
    multiply(Table::a, f, r);
    for (int k = 0; k < size; ++k) r[k] = of.h * r[k] - z[k];
    return all_finite<size>(r);
  }

  /// Simplified iteration from the z given, with the factorisations from `first` on. `contraction`
  /// is what `Watch` knows and learns.
  __attribute__((noinline)) static Trial iterate(const Task& of, int first, double* z,
                                                 double* contraction) {
    using Looks = Watch<n, s>;
    Looks watch(of.run, of.x, of.share, *contraction, 4096 * kEpsilon);
    typename Looks::Answer answer = Looks::go_on;
    while (answer == Looks::go_on) {
      double y[size], f[size], r[size];
      if (!evaluate(of, z, y, f, r)) return Trial::not_finite;
      correct(of.run, first, r);
      for (int k = 0; k < size; ++k) z[k] += r[k];
      if (!all_finite<size>(z)) return Trial::not_finite;
      answer = watch.see(r, z);
    }
    *contraction = watch.contraction;
    return answer == Looks::solved ? Trial::done : Trial::not_solved;
  }

  /// Newton's method from the z given, with new Jacobians until it contracts fast.
  __attribute__((cold, noinline)) static Trial iterate_fully(const Task& of, double* z) {
    if constexpr (size > kLargest) {
      return Trial::not_solved;
    } else {
      using Looks = Watch<n, s>;
      Looks watch(of.run, of.x, of.share, -1, kNoise);
      typename Looks::Answer answer = Looks::go_on;
      double last = 0;
      while (answer == Looks::go_on) {
        double y[size], f[size], r[size];
        if (!evaluate(of, z, y, f, r)) return Trial::not_finite;
        const bool fast = watch.level < 1e-2 * last;
        last = watch.level;
        if (!fast && !factor_fully(of, y, f)) return Trial::not_solved;
        of.run->solve(of.run->solver, kFull, r);
        for (int k = 0; k < size; ++k) z[k] += r[k];
        if (!all_finite<size>(z)) return Trial::not_finite;
        answer = watch.see(r, z);
      }
      return answer == Looks::solved ? Trial::done : Trial::not_solved;
    }
  }

  /// Factorises 1 - h A x (the Jacobians at the stages y).
  static bool factor_fully(const Task& of, const double* y, const double* f) {
    double matrix[size * size], J[n * n];
    for (int k = 0; k < s; ++k) {
      differentiate<System>(of.run, of.t + Table::c[k] * of.h, y + k * n, f + k * n, of.h, J,
                            of.evaluations);
      for (int d = 0; d < n; ++d)
        for (int j = 0; j < s; ++j)
          for (int c = 0; c < n; ++c)
            matrix[(k * n + d) * size + j * n + c] =
                (j == k && c == d ? 1 : 0) - of.h * Table::a[j * s + k] * J[d * n + c];
    }
    *of.jacobians += s;
    return of.run->factor(of.run->solver, kFull, size, matrix) == 0;
  }

  /// to_i = sum_j matrix_ij from_j, for s blocks of n numbers.
  static void multiply(const double* matrix, const double* from, double* to) {
    for (int i = 0; i < s; ++i)
      for (int k = 0; k < n; ++k) {
        double sum = 0;
        for (int j = 0; j < s; ++j) sum += matrix[i * s + j] * from[j * n + k];
        to[i * n + k] = sum;
      }
  }
};

}  // namespace radau

}  // namespace casimir_kernel
