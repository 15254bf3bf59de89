#pragma once

// What every integrator of this folder shares: rounding, the size of a step, and when to stop.
//
// The text of these headers is compiled again at run time in front of a generated right-hand side,
// so they include no standard header, allocate nothing and use fixed arrays only. A system is
//
//   struct System {
//     static constexpr int n;                                                   // states
//     static void rhs(double t, const double* x, const double* p, double* dx);
//     static void jacobian(double t, const double* x, const double* p, double* J);  // optional,
//   };                                                                          // n*n by columns

#include "runtime/kernels/unroll.hpp"
#include "runtime/module_abi.h"

namespace casimir_kernel {

constexpr double kEpsilon = 0x1p-52;
constexpr double kSmallest = 0x1p-1022;  // the smallest normal number

inline double magnitude(double a) { return __builtin_fabs(a); }
inline double larger(double a, double b) { return a > b ? a : b; }

/// True if none of n numbers is infinite or NaN.
template <int n>
inline bool all_finite(const double* x) {
  double zero = 0;
  for (int i = 0; i < n; ++i) zero += x[i] * 0;
  return zero == 0;
}

template <int n>
inline double largest(const double* x) {
  double size = 0;
  for (int i = 0; i < n; ++i) size = larger(size, magnitude(x[i]));
  return size;
}

/// total + carry becomes total + carry + increment; carry keeps what rounding would lose (Knuth's
/// exact sum), so that the error of many small steps does not grow with their number.
inline void add_carried(double& total, double& carry, double increment) {
  const double y = increment + carry;
  const double sum = total + y;
  const double part = sum - total;
  carry = (total - (sum - part)) + (y - part);
  total = sum;
}

/// a^(1/k) to within 1 %, for step sizes: positive a, one multiplication-long latency chain.
inline double rough_root(double a, int k) {
  a = a < 1e-300 ? 1e-300 : a > 1e300 ? 1e300 : a;
  long long bits;
  __builtin_memcpy(&bits, &a, sizeof bits);
  const double exponent = static_cast<double>((bits >> 52) - 1023);
  bits = (bits & 0xfffffffffffffLL) | 0x3ff0000000000000LL;
  double m;
  __builtin_memcpy(&m, &bits, sizeof m);
  const double log2 = (exponent + (m * (2 - m / 3) - 5. / 3)) / k;
  const long long whole = static_cast<long long>(log2 < 0 ? log2 - 1 : log2);
  const double part = log2 - static_cast<double>(whole);
  bits = (whole + 1023) << 52;
  __builtin_memcpy(&m, &bits, sizeof m);
  return m * (1 + part * (0.6565 + 0.3435 * part));
}

/// The right-hand side where it is evaluated once: not worth a copy of its text.
template <class System>
__attribute__((cold, noinline)) void cold_rhs(double t, const double* x, const double* p,
                                              double* dx) {
  System::rhs(t, x, p, dx);
}

/// The local error allowed to a component of size |a|. Never zero.
inline double allowed_error(const casimir_run* run, double a) {
  return larger(run->atol + run->rtol * magnitude(a), kSmallest);
}

/// A first step at which a method of this order should just meet the tolerance, from the size of
/// the state and of its first two derivatives (after Hairer, Norsett, Wanner I, II.4, but with the
/// time scale of the solution as the unit). Costs one evaluation.
template <class System>
__attribute__((cold, noinline)) double first_step(const casimir_run* run, const double* x,
                                                  const double* f, double span, int order) {
  constexpr int n = System::n;
  double size = 0, speed = 0, bend = 0;
  double moved[n], g[n];
  for (int i = 0; i < n; ++i) {
    const double unit = allowed_error(run, x[i]);
    size = larger(size, magnitude(x[i]) / unit);
    speed = larger(speed, magnitude(f[i]) / unit);
  }
  const double longest = magnitude(span);
  double h = 1e-6 * longest;
  if (size > 1e-5 && speed > 0 && 0.01 * (size / speed) < longest) h = 0.01 * (size / speed);
  if (!(h > 0)) return span;
  const double signed_h = span < 0 ? -h : h;
  for (int i = 0; i < n; ++i) moved[i] = x[i] + signed_h * f[i];
  cold_rhs<System>(run->t_begin + signed_h, moved, run->parameters, g);
  if (!all_finite<n>(g)) return signed_h;
  for (int i = 0; i < n; ++i)
    bend = larger(bend, magnitude(g[i] - f[i]) / allowed_error(run, x[i]));
  size = larger(size, speed * h);
  if (!(size > 0)) size = 1;  // at rest, at zero: what is allowed as an error
  const double rate = larger(speed / size, __builtin_sqrt(bend / size) / __builtin_sqrt(h));
  double best = rough_root(larger(size, 1) * 100, order) * rate;
  best = best * longest > 1 ? 1 / best : longest;
  best = best > 1000 * h ? 1000 * h : best;
  return span < 0 ? -best : best;
}

/// Why a run ends whose step has shrunk to nothing: a singularity if the solution now changes by
/// its own size in a vanishing part of the time passed, else whatever made the step shrink.
template <int n>
__attribute__((cold, noinline)) int status_of_vanished_step(double elapsed, const double* x,
                                                            const double* f, int failure) {
  const double passes = largest<n>(f) / largest<n>(x) * magnitude(elapsed);
  return passes > 1e6 ? CASIMIR_SINGULARITY : failure;
}

/// Whether steps have become much shorter than they were on average, as they do towards a
/// singularity. A run that only takes too long has even ones: cos(t) for 1e300 units of time.
inline bool has_shrunk(double h, double elapsed, unsigned long long steps) {
  return magnitude(h) * static_cast<double>(steps) < 0x1p-10 * magnitude(elapsed);
}

/// Whether a run gets anywhere. Steps that the tolerance asks for may be so short that no computer
/// takes as many as the interval needs, though each still moves the time.
class Pace {
 public:
  explicit Pace(double t) : t_(t) {}

  /// Asked at every trial: at the pace of the last million of them, would the rest take more than
  /// 2^36, a day and a night?
  bool hopeless(unsigned long long trials, double t, double end) {
    if (__builtin_expect(trials == 0 || (trials & (kTrials - 1)) != 0, 1)) return false;
    const double moved = magnitude(t - t_);
    t_ = t;
    return moved * (0x1p36 / kTrials) < magnitude(end - t);
  }

 private:
  static constexpr unsigned long long kTrials = 1ULL << 20;
  double t_;
};

/// The derivatives at the ends of a step, where interpolation by them is as good as the method:
/// where nothing is stiff.
template <class Step>
const double* rate_at_end(const Step& step) {
  if constexpr (requires { step.k13; })
    return step.k13;
  else
    return nullptr;
}
template <class Step>
const double* rate_at_start(const Step& step) {
  return rate_at_end(step) ? step.f : nullptr;
}

/// What became of one trial step.
enum class Trial { done, not_finite, not_solved };

/// Integrates with a one-step method, which is a class
///
///   struct Step {
///     static constexpr int power;    the error estimate behaves like h^power
///     double increment[n];           what `attempt` adds to the state; or instead, already summed,
///     double next[n], next_carry[n];
///     double f[n];                   the derivative at the current state
///     double error;                  of the last attempt, 1 = just allowed; only if `adaptive`
///     unsigned long long evaluations, jacobians;
///     bool begin(const casimir_run*, double span, const double* x);  f at the start; is it finite?
///     Trial attempt(double t, const double* x, const double* carry, double h, bool adaptive);
///     bool arrive(double t1, const double* x1);   f at the end of the step; is it finite?
///     void accept();                              the end becomes the current state
///     double settle(double factor);  optional: by which factor the next step shall be longer, of
///                                    an accepted one, given what its error alone would allow
///     static void dense(const casimir_step*, double t, double* x);  data is the Step
///   };
///
/// The state and the time are summed with a carry. A trial that fails in any way leaves both
/// untouched: what is returned is always the last accepted state. With a fixed step there is no
/// error control, but a step whose error estimate exceeds the state itself ends the run.
template <class System, class Step>
void march(const casimir_run* run, double* x, casimir_outcome* out) {
  constexpr int n = System::n;
  constexpr double kSafety = 0.9, kShrink = 0.2, kGrow = 6;
  // How fast the step may grow again that was too long to be solved.
  constexpr double kRelief = requires(Step s) { s.settle(1.); }
  ? 2 : 1.1;
  Step step;
  double carry[n], next[n], next_carry[n];
  double t = run->t_begin, t_carry = 0;
  const double span = run->t_end - run->t_begin;
  const bool adaptive = !(run->fixed_step > 0);
  casimir_run asked = *run;
  if (!adaptive) {  // then `error` is measured against the state itself
    asked.rtol = 1;
    asked.atol = largest<n>(x);
  }
  unsigned long long steps = 0, rejected = 0;
  out->steps = out->rejected = out->evaluations = out->jacobians = 0;
  out->t = t;
  out->status = CASIMIR_NON_FINITE;
  if (!all_finite<n>(x) || !__builtin_isfinite(span)) return;
  out->status = CASIMIR_OK;
  if (span == 0) return;

  double h = span, pieces = 0;
  int status = CASIMIR_OK;
  if (!step.begin(&asked, span, x)) status = CASIMIR_NON_FINITE;
  if (!adaptive) {
    pieces = __builtin_ceil(magnitude(span) / run->fixed_step * (1 - 4 * kEpsilon));
    pieces = larger(pieces, 1);
    h = span / pieces;
    if (!(pieces < 0x1p53)) status = CASIMIR_STEP_UNDERFLOW;
  } else if (status == CASIMIR_OK) {
    h = run->first_step;
    if (!(h > 0)) {
      h = magnitude(first_step<System>(run, x, step.f, span, Step::power));
      h = larger(h, 0x1p-40 * magnitude(t));
      ++step.evaluations;
    }
    if (span < 0) h = -h;
  }
  for (int i = 0; i < n; ++i) carry[i] = 0;

  double most = kGrow, ceiling = magnitude(span);
  int failure = CASIMIR_STEP_UNDERFLOW;
  bool there = false;
  Pace pace(t);
  while (status == CASIMIR_OK && !there) {
    if (run->max_steps && steps + rejected >= run->max_steps) {
      status = CASIMIR_MAX_STEPS;
      break;
    }
    if (adaptive && !run->max_steps && pace.hopeless(steps + rejected, t, run->t_end)) {
      status = CASIMIR_STEP_UNDERFLOW;
      if (has_shrunk(h, t - run->t_begin, steps))
        status = status_of_vanished_step<n>(t - run->t_begin, x, step.f, status);
      break;
    }
    double t1 = t, t1_carry = t_carry, trial = h;
    if (adaptive) {
      const double rest = (run->t_end - t) - t_carry;
      there = magnitude(rest) <= 1.01 * magnitude(h);
      if (there)
        trial = rest;
      else if (magnitude(h) <= larger(16 * kEpsilon * magnitude(t), 16 * kSmallest)) {
        status = status_of_vanished_step<n>(t - run->t_begin, x, step.f, failure);
        break;
      } else if (magnitude(rest) < 2 * magnitude(h)) {
        trial = rest / 2;
      }
      add_carried(t1, t1_carry, trial);
    } else {
      const double index = static_cast<double>(steps + 1);
      there = index >= pieces;
      t1 = run->t_begin + index * h;
      t1_carry = 0;
    }
    if (there) t1 = run->t_end;

    double part = 1;
    Trial result = step.attempt(t, x, carry, trial, adaptive);
    bool good = result == Trial::done && step.error <= 1;
    if (good) {
      for (int i = 0; i < n; ++i) {
        if constexpr (requires { step.increment; }) {
          next[i] = x[i];
          next_carry[i] = carry[i];
          add_carried(next[i], next_carry[i], step.increment[i]);
        } else {
          next[i] = step.next[i];
          next_carry[i] = step.next_carry[i];
        }
      }
      if (run->project && all_finite<n>(next)) run->project(run->projector, t1, next, next_carry);
      if (!all_finite<n>(next) || !step.arrive(t1, next)) {
        good = false;
        result = Trial::not_finite;
      } else if (run->look && adaptive) {
        const casimir_step seen = {
            t, t1, x, next, &Step::dense, &step, rate_at_start(step), rate_at_end(step)};
        part = run->look(run->looker, &seen);
        good = part >= 1;
      }
    }
    if (result == Trial::done && !(step.error <= 1e300)) result = Trial::not_finite;
    if (!good) {
      ++rejected;
      there = false;
      failure = result == Trial::not_finite                ? CASIMIR_NON_FINITE
                : result == Trial::not_solved || !adaptive ? CASIMIR_NO_CONVERGENCE
                                                           : CASIMIR_STEP_UNDERFLOW;
      if (!adaptive) {
        status = status_of_vanished_step<n>(t - run->t_begin, x, step.f, failure);
        break;
      }
      const double factor = kSafety / rough_root(step.error, Step::power);
      h = trial * (part < 1                      ? part
                   : result == Trial::not_solved ? 0.5
                   : result != Trial::done       ? 0.25
                   : factor < kShrink            ? kShrink
                                                 : factor);
      most = 1;
      if (result == Trial::not_solved) ceiling = magnitude(trial) / 2;
      continue;
    }
    ++steps;
    int stop = 0;
    if (run->observe) {
      const casimir_step seen = {
          t, t1, x, next, &Step::dense, &step, rate_at_start(step), rate_at_end(step)};
      stop = run->observe(run->observer, &seen);
    }
    step.accept();
    t = t1;
    t_carry = t1_carry;
    for (int i = 0; i < n; ++i) {
      x[i] = next[i];
      carry[i] = next_carry[i];
    }
    // A motion that begins at zero has no size at first, and one that comes back to it keeps its.
    if (!adaptive) asked.atol = larger(asked.atol, largest<n>(x));
    if (stop && !there) status = CASIMIR_STOPPED;
    if (adaptive) {
      double factor = kSafety / rough_root(step.error, Step::power);
      if constexpr (requires { step.settle(factor); }) factor = step.settle(factor);
      h = trial * (factor > most ? most : factor < kShrink ? kShrink : factor);
      if (magnitude(h) > ceiling) h = span < 0 ? -ceiling : ceiling;
      if (ceiling < magnitude(span)) ceiling *= kRelief;
      most = kGrow;
      failure = CASIMIR_STEP_UNDERFLOW;
    }
  }
  out->status = status;
  out->t = t;
  out->steps = steps;
  out->rejected = rejected;
  out->evaluations = step.evaluations;
  out->jacobians = step.jacobians;
}

}  // namespace casimir_kernel
