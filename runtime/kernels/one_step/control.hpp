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

#include "runtime/kernels/carried_sum.hpp"
#include "runtime/kernels/inline.hpp"
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

  /// Asked at every trial, or after several: at the pace of the last million of them, would the
  /// rest take more than 2^36, a day and a night?
  bool hopeless(unsigned long long trials, double t, double end) {
    if (__builtin_expect(trials < next_, 1)) return false;
    const double moved = magnitude(t - t_);
    const double since = static_cast<double>(trials - next_ + kTrials);
    t_ = t;
    next_ = trials + kTrials;
    return moved * 0x1p36 < since * magnitude(end - t);
  }

 private:
  static constexpr unsigned long long kTrials = 1ULL << 20;
  unsigned long long next_ = kTrials;
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
class March {
  static constexpr int n = System::n;
  static constexpr double kSafety = 0.9, kShrink = 0.2, kGrow = 6;
  /// How fast the step may grow again that was too long to be solved.
  static constexpr double kRelief = requires(Step s) { s.settle(1.); }
  ? 2 : 1.1;

 public:
  March(const casimir_run* run, double* x, casimir_outcome* out)
      : run_(run),
        x_(x),
        out_(out),
        adaptive_(!(run->fixed_step > 0)),
        span_(run->t_end - run->t_begin),
        asked_(*run),
        t_(run->t_begin),
        ceiling_(magnitude(span_)),
        pace_(run->t_begin) {}

  void go() {
    for (int i = 0; i < n; ++i) state_[i] = x_[i];
    if (!all_finite<n>(state_) || !__builtin_isfinite(span_)) status_ = CASIMIR_NON_FINITE;
    if (status_ == CASIMIR_OK && span_ != 0) {
      begin();
      while (status_ == CASIMIR_OK && !there_) {
        double t1 = t_, t1_carry = t_carry_, trial = h_;
        if (!may_go_on() || !plan(t1, t1_carry, trial)) break;
        if (attempt(t1, trial)) {
          accept(t1, t1_carry);
          if (adaptive_) choose_next(trial);
        } else {
          reject(trial);
        }
      }
    }
    finish();
  }

 private:
  void begin() {
    if (!adaptive_) {  // then `error` is measured against the state itself
      asked_.rtol = 1;
      asked_.atol = largest<n>(state_);
    }
    if (!step_.begin(&asked_, span_, state_)) status_ = CASIMIR_NON_FINITE;
    h_ = span_;
    if (!adaptive_) {
      pieces_ = __builtin_ceil(magnitude(span_) / run_->fixed_step * (1 - 4 * kEpsilon));
      pieces_ = larger(pieces_, 1);
      h_ = span_ / pieces_;
      if (!(pieces_ < 0x1p53)) status_ = CASIMIR_STEP_UNDERFLOW;
    } else if (status_ == CASIMIR_OK) {
      h_ = run_->first_step;
      if (!(h_ > 0)) {
        h_ = magnitude(first_step<System>(run_, state_, step_.f, span_, Step::power));
        h_ = larger(h_, 0x1p-40 * magnitude(t_));
        ++step_.evaluations;
      }
      if (span_ < 0) h_ = -h_;
    }
    for (int i = 0; i < n; ++i) carry_[i] = 0;
  }

  /// The end of a run whose steps lead nowhere.
  void give_up(int failure) {
    status_ = status_of_vanished_step<n>(t_ - run_->t_begin, state_, step_.f, failure);
  }

  bool may_go_on() {
    if (run_->max_steps && steps_ + rejected_ >= run_->max_steps) {
      status_ = CASIMIR_MAX_STEPS;
      return false;
    }
    if (adaptive_ && !run_->max_steps && pace_.hopeless(steps_ + rejected_, t_, run_->t_end)) {
      status_ = CASIMIR_STEP_UNDERFLOW;
      if (has_shrunk(h_, t_ - run_->t_begin, steps_)) give_up(status_);
      return false;
    }
    return true;
  }

  /// The length of the next step and the time at its end; false where it would be none.
  CASIMIR_INLINE bool plan(double& t1, double& t1_carry, double& trial) {
    if (adaptive_) {
      const double rest = (run_->t_end - t_) - t_carry_;
      there_ = magnitude(rest) <= 1.01 * magnitude(h_);
      if (there_)
        trial = rest;
      else if (magnitude(h_) <= larger(16 * kEpsilon * magnitude(t_), 16 * kSmallest)) {
        give_up(failure_);
        return false;
      } else if (magnitude(rest) < 2 * magnitude(h_)) {
        trial = rest / 2;
      }
      add_carried(t1, t1_carry, trial);
    } else {
      const double index = static_cast<double>(steps_ + 1);
      there_ = index >= pieces_;
      t1 = run_->t_begin + index * h_;
      t1_carry = 0;
    }
    if (there_) t1 = run_->t_end;
    return true;
  }

  CASIMIR_INLINE casimir_step seen(double t1) const {
    return {t_, t1, state_, next_, &Step::dense, &step_, rate_at_start(step_), rate_at_end(step_)};
  }

  /// A trial of a step: whether it may be taken.
  CASIMIR_INLINE bool attempt(double t1, double trial) {
    part_ = 1;
    result_ = step_.attempt(t_, state_, carry_, trial, adaptive_);
    bool good = result_ == Trial::done && step_.error <= 1;
    if (good) {
      add_increment();
      if (run_->project && all_finite<n>(next_))
        run_->project(run_->projector, t1, next_, next_carry_);
      if (!all_finite<n>(next_) || !step_.arrive(t1, next_)) {
        good = false;
        result_ = Trial::not_finite;
      } else if (run_->look && adaptive_) {
        const casimir_step trial_step = seen(t1);
        part_ = run_->look(run_->looker, &trial_step);
        good = part_ >= 1;
      }
    }
    if (result_ == Trial::done && !(step_.error <= 1e300)) result_ = Trial::not_finite;
    return good;
  }

  CASIMIR_INLINE void add_increment() {
    for (int i = 0; i < n; ++i) {
      if constexpr (requires(Step s) { s.increment; }) {
        next_[i] = state_[i];
        next_carry_[i] = carry_[i];
        add_carried(next_[i], next_carry_[i], step_.increment[i]);
      } else {
        next_[i] = step_.next[i];
        next_carry_[i] = step_.next_carry[i];
      }
    }
  }

  /// What is tried next, or the end.
  __attribute__((noinline)) void reject(double trial) {
    ++rejected_;
    there_ = false;
    failure_ = result_ == Trial::not_finite                 ? CASIMIR_NON_FINITE
               : result_ == Trial::not_solved || !adaptive_ ? CASIMIR_NO_CONVERGENCE
                                                            : CASIMIR_STEP_UNDERFLOW;
    if (!adaptive_) {
      give_up(failure_);
      return;
    }
    const double factor = kSafety / rough_root(step_.error, Step::power);
    h_ = trial * (part_ < 1                      ? part_
                  : result_ == Trial::not_solved ? 0.5
                  : result_ != Trial::done       ? 0.25
                  : factor < kShrink             ? kShrink
                                                 : factor);
    most_ = 1;
    if (result_ == Trial::not_solved) ceiling_ = magnitude(trial) / 2;
  }

  CASIMIR_INLINE void accept(double t1, double t1_carry) {
    ++steps_;
    int stop = 0;
    if (run_->observe) {
      const casimir_step step = seen(t1);
      stop = run_->observe(run_->observer, &step);
    }
    step_.accept();
    t_ = t1;
    t_carry_ = t1_carry;
    for (int i = 0; i < n; ++i) {
      state_[i] = next_[i];
      carry_[i] = next_carry_[i];
    }
    // A motion that begins at zero has no size at first, and one that comes back to it keeps its.
    if (!adaptive_) asked_.atol = larger(asked_.atol, largest<n>(state_));
    if (stop && !there_) status_ = CASIMIR_STOPPED;
  }

  CASIMIR_INLINE void choose_next(double trial) {
    double factor = kSafety / rough_root(step_.error, Step::power);
    if constexpr (requires(Step s) { s.settle(1.); }) factor = step_.settle(factor);
    h_ = trial * (factor > most_ ? most_ : factor < kShrink ? kShrink : factor);
    if (magnitude(h_) > ceiling_) h_ = span_ < 0 ? -ceiling_ : ceiling_;
    if (ceiling_ < magnitude(span_)) ceiling_ *= kRelief;
    most_ = kGrow;
    failure_ = CASIMIR_STEP_UNDERFLOW;
  }

  void finish() {
    for (int i = 0; i < n; ++i) x_[i] = state_[i];
    out_->status = status_;
    out_->t = t_;
    out_->steps = steps_;
    out_->rejected = rejected_;
    out_->evaluations = step_.evaluations;
    out_->jacobians = step_.jacobians;
  }

  const casimir_run* run_;
  double* x_;
  casimir_outcome* out_;
  const bool adaptive_;
  const double span_;
  casimir_run asked_;
  Step step_;
  double state_[n], carry_[n], next_[n], next_carry_[n];
  double t_, t_carry_ = 0;
  double h_ = 0, pieces_ = 0, most_ = kGrow, ceiling_;
  double part_ = 1;  // of a step that was looked at, what is tried next
  Trial result_ = Trial::done;
  unsigned long long steps_ = 0, rejected_ = 0;
  int status_ = CASIMIR_OK, failure_ = CASIMIR_STEP_UNDERFLOW;
  bool there_ = false;
  Pace pace_;
};

template <class System, class Step>
void march(const casimir_run* run, double* x, casimir_outcome* out) {
  March<System, Step>(run, x, out).go();
}

}  // namespace casimir_kernel
