#pragma once

#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/one_step/radau_newton.hpp"
#include "runtime/kernels/one_step/radau_tableau.hpp"

namespace casimir_kernel {

namespace radau {

/// One step of the Radau IIA collocation method with s stages.
///
/// Order 2s - 1, L-stable and stiffly accurate: for stiff and damped systems. What is solved for
/// are the increments of the stages, iterated down to a small part of the tolerance or to rounding,
/// from the collocation polynomial of the last step. The Jacobian and its factorisations are kept
/// while the step is unchanged and the iteration contracts fast. Without a Jacobian in `System` the
/// one of finite differences serves.
///
/// The error estimate is the difference to a method of order s, through (gamma - h J)^-1, which
/// takes from it what a stiff component does not feel. It behaves like h^(s + 1), and is therefore
/// compared with 0.01 rtol^((s + 1) / 2s) (Hairer, Wanner II, IV.8; J. Comput. Appl. Math. 111
/// (1999) 93, with a smaller factor, since stiff components do not have the full order); atol is
/// taken as it is, since components below it are seldom smooth. The dense output takes a shorter
/// step of the same method from the collocation polynomial: of order 2s - 1 too, and costs an
/// implicit solve a point.
template <class System, int s>
struct Step {
  static constexpr int n = System::n, size = n * s;
  static constexpr int power = s + 1;
  using Table = Tableau<s>;
  using Equations = Newton<System, s>;
  static constexpr int kOfDense = 1 + Equations::pairs;  // the first of its factorisations
  static constexpr double kShare = 0.02;  // of the tolerance, for errors of the iteration
  static constexpr double kSlow = 0.05;   // a contraction that calls for a new Jacobian
  static constexpr double kFar = 4;       // no polynomial is extrapolated over as many steps
  static constexpr int kTurning = 20;     // steps after one whose stiff directions turned

  double z[size] = {}, last_z[size] = {};  // increments of the stages, of this step and of the last
  double J[n * n];
  double increment[n], f[n], f1[n];
  double h = 0, last_h = 0, error = 0, last_error = 0;
  double factored = 0;      // the step for which the factorisations are
  double contraction = -1;  // of the iteration with them
  double raised = 0, share = 0;
  bool here = false;    // J belongs to the current state
  bool doubted = true;  // the last estimate was too large, or there is none
  int turning = 0;      // further steps to be solved by Newton's method itself at once
  const casimir_run* run = nullptr;
  unsigned long long evaluations = 0, jacobians = 0;

  bool begin(const casimir_run* asked, double, const double* start) {
    run = asked;
    double power_of_it = 1;
    for (int k = 0; k < (s + 1) / 2; ++k) power_of_it *= run->rtol;
    raised = 0.01 * rough_root(power_of_it, s);
    System::rhs(run->t_begin, start, run->parameters, f);
    ++evaluations;
    return all_finite<n>(f);
  }

  Trial attempt(double t, const double* x, const double* carry, double step, bool adaptive) {
    if (!run->factor || !run->solve) return Trial::not_solved;
    h = step;
    share = adaptive ? kShare : 0;
    const Trial result = solve({run, t, x, carry, h, share, &evaluations, &jacobians});
    if (result != Trial::done) return result;
    if (h != factored && !renew(t, x)) return Trial::not_solved;
    for (int i = 0; i < n; ++i) increment[i] = z[size - n + i];
    error = estimate(x, f, adaptive);
    if (!(error <= 1) && doubted) error = second_estimate(t, x, adaptive);
    doubted = !(error <= 1);
    return Trial::done;
  }

  bool arrive(double t1, const double* x1) {
    System::rhs(t1, x1, run->parameters, f1);
    ++evaluations;
    return all_finite<n>(f1);
  }

  void accept() {
    for (int k = 0; k < size; ++k) last_z[k] = z[k];
    for (int i = 0; i < n; ++i) f[i] = f1[i];
    here = false;
    if (turning > 0) --turning;
  }

  /// By which factor the step may grow after an accepted one: the trend of the error counts
  /// (Gustafsson, ACM Trans. Math. Softw. 20 (1994) 496), and no small gain is worth a new matrix.
  double settle(double factor) {
    if (last_h != 0) {
      const double trend = h / last_h * rough_root(last_error / larger(error, 1e-10), power);
      factor = trend < 1 ? factor * trend : factor;
    }
    last_h = h;
    last_error = larger(error, 1e-2);
    return factor > 1 && factor < 1.2 ? 1 : factor;
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    Step* self = static_cast<Step*>(const_cast<void*>(step->data));
    self->inside(step->t0, step->x0, (t - step->t0) / self->h, at);
  }

 private:
  using Task = typename Equations::Task;

  /// Solves for z, from the cheapest way to the surest.
  Trial solve(const Task& task) {
    Trial result = Trial::not_solved;
    if (turning == 0) {
      const bool kept = h == factored && contraction < kSlow;
      guess();
      if (!kept && !renew(task.t, task.x)) return result;
      result = Equations::iterate(task, 0, z, &contraction);
      if (result != Trial::done && !here) {
        guess();
        if (!renew(task.t, task.x)) return result;
        result = Equations::iterate(task, 0, z, &contraction);
      }
      if (result == Trial::done) return result;
      turning = kTurning;
    }
    const bool known = guess();
    result = Equations::iterate_fully(task, z);
    if (result == Trial::done || !known) return result;
    for (int k = 0; k < size; ++k) z[k] = 0;
    return Equations::iterate_fully(task, z);
  }

  /// What the polynomial through 0 at 0 and the values of the stages at c is at a time: s weights.
  static void weigh(double at, double* weights) {
    for (int k = 0; k < s; ++k) {
      double value = at / Table::c[k];
      for (int m = 0; m < s; ++m)
        value *= m == k ? 1 : (at - Table::c[m]) / (Table::c[k] - Table::c[m]);
      weights[k] = value;
    }
  }

  /// Begins with the stages as the last step's polynomial continues, if that is near enough.
  bool guess() {
    const bool known = last_h != 0 && magnitude(h) < kFar * magnitude(last_h);
    for (int j = 0; j < s; ++j) {
      double weights[s] = {};
      if (known) {
        weigh(1 + Table::c[j] * (h / last_h), weights);
        weights[s - 1] -= 1;
      }
      interpolate(weights, last_z, z + j * n);
    }
    return known;
  }

  static void interpolate(const double* weights, const double* from, double* to) {
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int k = 0; k < s; ++k) sum += weights[k] * from[k * n + i];
      to[i] = sum;
    }
  }

  /// The Jacobian at the current state, and its factorisations for the step h.
  bool renew(double t, const double* x) {
    if (!here) {
      differentiate<System>(run, t, x, f, h, J, &evaluations);
      ++jacobians;
      here = true;
    }
    contraction = -1;
    factored = Equations::factor(run, 0, h, J) ? h : 0;
    return factored != 0;
  }

  /// The estimated error of the step in units of what is allowed, for the derivative at the start;
  /// in f1 the estimate itself. The tolerance is raised for a component as far as the matrix left
  /// its estimate as it was: what it took down is stiff, and has not the full order.
  double estimate(const double* x, const double* slope, bool adaptive) {
    double raw[n], worst = 0;
    for (int i = 0; i < n; ++i) {
      raw[i] = h * slope[i];
      for (int j = 0; j < s; ++j) raw[i] += Table::e[j] * z[j * n + i];
      f1[i] = raw[i];
    }
    run->solve(run->solver, 0, f1);
    for (int i = 0; i < n; ++i) {
      const double reach = larger(magnitude(x[i]), magnitude(x[i] + increment[i]));
      const double left = Table::gamma * magnitude(f1[i]), whole = magnitude(raw[i]);
      const double rate = left < whole ? larger(run->rtol, raised * (left / whole)) : raised;
      const double allowed = adaptive ? rate * reach + run->atol : allowed_error(run, reach);
      const double part = magnitude(f1[i]) / larger(allowed, kSmallest);
      worst = part <= worst ? worst : part;  // a NaN must not look like a small error
    }
    return worst;
  }

  /// With the slope at a state less that error: what is damped in the first step does not count.
  double second_estimate(double t, const double* x, bool adaptive) {
    double y[n], slope[n];
    for (int i = 0; i < n; ++i) y[i] = x[i] + f1[i];
    System::rhs(t, y, run->parameters, slope);
    ++evaluations;
    return all_finite<n>(slope) ? estimate(x, slope, adaptive) : error;
  }

  /// The state after a part of the step.
  void inside(double t, const double* x, double part, double* at) {
    const double none[n] = {};
    double inner[size], weights[s], unknown = -1;
    const auto begin = [&] {
      for (int j = 0; j < s; ++j) {
        weigh(part * Table::c[j], weights);
        interpolate(weights, z, inner + j * n);
      }
    };
    const Task task = {run, t, x, none, part * h, share, &evaluations, &jacobians};
    begin();
    Trial result = Trial::not_solved;
    if (turning == 0 && Equations::factor(run, kOfDense, part * h, J))
      result = Equations::iterate(task, kOfDense, inner, &unknown);
    if (result != Trial::done) {
      begin();
      result = Equations::iterate_fully(task, inner);
    }
    if (result != Trial::done) begin();  // the polynomial itself, of order s
    for (int i = 0; i < n; ++i) at[i] = x[i] + inner[size - n + i];
  }
};

template <class System, int s>
void integrate(const casimir_run* run, double* x, casimir_outcome* out) {
  march<System, Step<System, s>>(run, x, out);
}

}  // namespace radau

}  // namespace casimir_kernel
