#pragma once

#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/one_step/gauss_tableau.hpp"

namespace casimir_kernel {

namespace gauss {

/// The local error is about this constant times (defect / size)^(2s / (s + 1)); measured on tops,
/// so that the error after a hundred turns is 1 to 30 times the tolerance.
template <int s>
constexpr double kCalibration = s <= 2   ? 1
                                : s == 3 ? 0.25
                                : s == 4 ? 0.1
                                : s == 6 ? 0.04
                                         : 0.02;

/// One step of the Gauss collocation method with s stages.
///
/// With one stage it is the implicit midpoint rule. Order 2s, A-stable, symmetric, symplectic;
/// keeps every quadratic invariant, in floating point to rounding that does not accumulate one way:
/// the products L_j = h b_j f_j are the unknowns, Y_i = x + sum mu_ij L_j with mu_ij + mu_ji = 1
/// exactly, the stage equations are iterated until rounding stops them (Hairer, McLachlan,
/// Razakarivony, BIT 48 (2008) 231), and the state is summed with a carry. Fixed-point iteration
/// from the extrapolated last step; where that does not contract, simplified Newton iteration with
/// the caller's linear solver, if there is one.
///
/// The error is estimated by the defect e = h |p'(1) - f(x1)| of the collocation polynomial, of
/// order s + 1; its power 2s / (s + 1) has the order of the error a unit of time. Pessimistic on
/// stiff systems. The dense output takes a shorter step of the same method, hence is of order 2s
/// too and costs an implicit solve a point. An adaptive step spoils the long-time behaviour; then
/// prefer a fixed step.
template <class System, int s>
struct Step {
  static constexpr int n = System::n;
  static constexpr int size = n * s;
  static constexpr int power = 2 * s;
  static constexpr int kSweeps = 60;
  using Table = Tableau<s>;

  struct Stages {
    double f[size];  // derivatives at the nodes, stage by stage
    double L[size];  // h b_j f_j
  };

  Stages last, current, between;  // of the last step, of this one, of dense output
  double increment[n], f[n], f1[n];
  double last_h = 0, h = 0, error = 0;
  double ratio = -1;      // of h to last_h, for which `weights` were computed
  double weights[s * s];  // of the extrapolation to the nodes of this step
  const casimir_run* run = nullptr;
  int newton = 0;  // further steps to be solved by Newton's method at once
  unsigned long long evaluations = 0, jacobians = 0;

  static constexpr double mu(int i, int j) {
    return i == j  ? 0.5
           : i > j ? Table::mu[i * (i - 1) / 2 + j]
                   : 1 - Table::mu[j * (j - 1) / 2 + i];
  }

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    System::rhs(run->t_begin, start, run->parameters, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  /// Lagrange's polynomials of the nodes at `at`, s values.
  __attribute__((noinline)) static void lagrange(double at, double* values) {
    for (int k = 0; k < s; ++k) {
      double top = 1, bottom = 1;
      for (int m = 0; m < s; ++m) {
        top *= m == k ? 1 : at - Table::c[m];
        bottom *= m == k ? 1 : Table::c[k] - Table::c[m];
      }
      values[k] = top / bottom;
    }
  }

  /// Weights h b_j whose sum is h to rounding.
  static void scaled_weights(double step, double* hb) {
    double rest = step;
    for (int j = 1; j + 1 < s; ++j) rest -= hb[j] = step * Table::b[j];
    hb[0] = hb[s - 1] = s == 1 ? rest : rest / 2;
  }

  /// Y_i, the argument of stage i.
  static void stage(int i, const double* x, const double* carry, const double* L, double* y) {
    double sum[n];
    CASIMIR_UNROLL
    for (int c = 0; c < n; ++c) sum[c] = carry[c];
    for (int j = 0; j < s; ++j) {
      const double weight = mu_table[i * s + j];
      CASIMIR_UNROLL
      for (int c = 0; c < n; ++c) sum[c] += weight * L[j * n + c];
    }
    CASIMIR_UNROLL
    for (int c = 0; c < n; ++c) y[c] = x[c] + sum[c];
  }

  /// Watches the corrections of an iteration: smaller and smaller until they are rounding errors.
  struct Watch {
    double best[n], noise[n], scale[n];
    double level = 0;  // the largest correction, relative to the state
    int bad = 0;       // sweeps without progress above the level of rounding
    Watch(const double* L, const double* x) {
      const double all = 1e-2 * largest<n>(x);
      for (int i = 0; i < n; ++i) {
        double unit = magnitude(x[i]);
        for (int j = 0; j < s; ++j) unit = larger(unit, magnitude(L[j * n + i]));
        best[i] = __builtin_inf();
        noise[i] = 64 * kEpsilon * unit;
        scale[i] = 1 / larger(larger(unit, all), kSmallest);
      }
    }
    enum Answer { go_on, solved, hopeless };
    Answer see(const double* delta) {
      bool progress = false, grows = false;
      level = 0;
      CASIMIR_UNROLL
      for (int i = 0; i < n; ++i) {
        // A correction of zero says nothing: with one stage, those of a position and of its
        // momentum vanish in turn.
        const bool smaller = delta[i] < best[i] && delta[i] != 0;
        progress |= smaller;
        grows |= delta[i] > 1e3 * best[i] && delta[i] > noise[i];
        best[i] = smaller ? delta[i] : best[i];
        level = larger(level, delta[i] * scale[i]);
      }
      if (progress) return go_on;
      if (level <= 4096 * kEpsilon && !grows) return solved;
      return ++bad < 3 ? go_on : hopeless;
    }
  };

  /// Solves for the stages from the guess in `stages->L`. Leaves derivatives and products there.
  __attribute__((noinline)) Trial solve(double t, const double* x, const double* carry, double step,
                                        const double* hb, Stages* stages) {
    double* L = stages->L;
    Watch watch(L, x);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double delta[n] = {};
      for (int j = 0; j < s; ++j) {
        double y[n];
        double* fj = stages->f + j * n;
        stage(j, x, carry, L, y);
        System::rhs(t + Table::c[j] * step, y, run->parameters, fj);
        CASIMIR_UNROLL
        for (int i = 0; i < n; ++i) {
          const double fresh = hb[j] * fj[i];
          delta[i] = larger(delta[i], magnitude(fresh - L[j * n + i]));
          L[j * n + i] = fresh;
        }
      }
      evaluations += s;
      if (!all_finite<size>(L)) return Trial::not_finite;
      const typename Watch::Answer answer = watch.see(delta);
      if (answer == Watch::solved) return Trial::done;
      if (answer == Watch::hopeless) return Trial::not_solved;
      // A crawling iteration is for Newton's method, or for a smaller step.
      if (sweep == 20 && watch.level > 1e-8) return Trial::not_solved;
    }
    return watch.level <= 4096 * kEpsilon ? Trial::done : Trial::not_solved;
  }

  /// Simplified Newton iteration with the Jacobian at the start of the step.
  __attribute__((cold, noinline)) Trial solve_by_newton(double t, const double* x,
                                                        const double* carry, double step,
                                                        const double* hb, Stages* stages) {
    if constexpr (size <= 256 && requires(double* J) { System::jacobian(0., J, J, J); }) {
      double J[n * n], matrix[size * size];
      System::jacobian(t, x, run->parameters, J);
      ++jacobians;
      for (int k = 0; k < s; ++k)
        for (int d = 0; d < n; ++d)
          for (int j = 0; j < s; ++j)
            for (int c = 0; c < n; ++c)
              matrix[(k * n + d) * size + j * n + c] =
                  (j == k && c == d ? 1. : 0.) - hb[j] * mu_table[j * s + k] * J[d * n + c];
      if (run->factor(run->solver, 0, size, matrix)) return Trial::not_solved;
      double* L = stages->L;
      Watch watch(L, x);
      for (int sweep = 0; sweep < kSweeps; ++sweep) {
        double residual[size], delta[n] = {};
        for (int j = 0; j < s; ++j) {
          double y[n];
          double* fj = stages->f + j * n;
          stage(j, x, carry, L, y);
          System::rhs(t + Table::c[j] * step, y, run->parameters, fj);
          for (int i = 0; i < n; ++i) residual[j * n + i] = hb[j] * fj[i] - L[j * n + i];
        }
        evaluations += s;
        if (!all_finite<size>(residual)) return Trial::not_finite;
        run->solve(run->solver, 0, residual);
        for (int j = 0; j < s; ++j)
          for (int i = 0; i < n; ++i) {
            delta[i] = larger(delta[i], magnitude(residual[j * n + i]));
            L[j * n + i] += residual[j * n + i];
          }
        const typename Watch::Answer answer = watch.see(delta);
        if (answer == Watch::solved) return Trial::done;
        if (answer == Watch::hopeless) return Trial::not_solved;
      }
      return watch.level <= 4096 * kEpsilon ? Trial::done : Trial::not_solved;
    } else {
      (void)t, (void)x, (void)carry, (void)step, (void)hb, (void)stages;
      return Trial::not_solved;
    }
  }

  /// The stages of a step of size `step`, guessed from `known` by the weights w (s rows of s), or
  /// from the derivative at the start where w is null.
  __attribute__((noinline)) Trial find(double t, const double* x, const double* carry, double step,
                                       const Stages* known, const double* w, Stages* stages) {
    double hb[s];
    scaled_weights(step, hb);
    auto guess = [&] {
      for (int j = 0; j < s; ++j)
        for (int i = 0; i < n; ++i) {
          double slope = w ? 0 : f[i];
          for (int k = 0; w && k < s; ++k) slope += w[j * s + k] * known->f[k * n + i];
          stages->L[j * n + i] = hb[j] * slope;
        }
    };
    const bool solver = run->factor && run->solve;
    Trial result = Trial::not_solved;
    guess();
    if (!(newton > 0 && solver)) result = solve(t, x, carry, step, hb, stages);
    if (result != Trial::done && solver) {
      if (newton <= 0) {
        newton = 50;
        guess();
      }
      result = solve_by_newton(t, x, carry, step, hb, stages);
      if (result == Trial::not_solved) newton = 0;
    }
    return result;
  }

  Trial attempt(double t, const double* x, const double* carry, double step, bool) {
    h = step;
    const bool known = last_h != 0 && h / last_h < 3;
    if (known && ratio != h / last_h) {
      ratio = h / last_h;
      for (int j = 0; j < s; ++j) lagrange(1 + Table::c[j] * ratio, weights + j * s);
    }
    const Trial result = find(t, x, carry, h, &last, known ? weights : nullptr, &current);
    if (result != Trial::done) return result;

    double end[s], x1[n];
    lagrange(1, end);
    for (int i = 0; i < n; ++i) {
      increment[i] = 0;
      for (int j = 0; j < s; ++j) increment[i] += current.L[j * n + i];
      x1[i] = x[i] + increment[i];
    }
    System::rhs(t + h, x1, run->parameters, f1);
    ++evaluations;
    error = 0;
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      double slope = 0, moves = 0;
      for (int j = 0; j < s; ++j) {
        slope += end[j] * current.f[j * n + i];
        moves = larger(moves, magnitude(current.f[j * n + i]));
      }
      const double reach = larger(magnitude(x[i]), magnitude(x1[i]));
      const double scale = larger(larger(reach, magnitude(h) * moves), kSmallest);
      const double defect = magnitude(h) * magnitude(slope - f1[i]);
      // A NaN here must not look like a small error.
      const double part = (defect / scale) * (defect / allowed_error(run, reach));
      error = part <= error ? error : part;
      worst = larger(worst, defect / scale);
    }
    error *= kCalibration<s> / rough_root(worst * worst, s + 1);
    return all_finite<n>(increment) ? Trial::done : Trial::not_finite;
  }

  bool arrive(double, const double*) { return all_finite<n>(f1); }

  void accept() {
    last = current;
    last_h = h;
    if (newton > 0) --newton;
    for (int i = 0; i < n; ++i) f[i] = f1[i];
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    Step* self = static_cast<Step*>(const_cast<void*>(step->data));
    const double part = (t - step->t0) / self->h, none[n] = {};
    double w[s * s];
    for (int j = 0; j < s; ++j) lagrange(part * Table::c[j], w + j * s);
    const Trial result =
        self->find(step->t0, step->x0, none, part * self->h, &self->current, w, &self->between);
    for (int i = 0; i < n; ++i) {
      at[i] = step->x0[i];
      for (int j = 0; j < s && result == Trial::done; ++j) at[i] += self->between.L[j * n + i];
      if (result != Trial::done) at[i] = __builtin_nan("");
    }
  }

  struct MuTable {
    double entry[s * s];
    constexpr MuTable() : entry() {
      for (int i = 0; i < s; ++i)
        for (int j = 0; j < s; ++j) entry[i * s + j] = mu(i, j);
    }
    constexpr double operator[](int k) const { return entry[k]; }
  };
  static constexpr MuTable mu_table{};
};

template <class System, int s>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System, s>>(run, x, out);
}

}  // namespace gauss

}  // namespace casimir_kernel
