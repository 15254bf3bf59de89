#pragma once

#include "runtime/kernels/lanes/lanes.hpp"
#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/taylor/step_choice.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"
#include "runtime/kernels/taylor/sums.hpp"

namespace casimir_kernel {

/// The method of Taylor series: each step sums the solution's own power series.
///
/// The coefficients come from a class
///
///   struct Series {
///     using V;                          a register
///     static constexpr int room;        most registers that may hold a state
///     int blocks;                       registers that do, filled up with zeros
///     int states;
///     bool smooth;                      the right-hand side is a polynomial of low degree
///     int order;                        a multiple of 4
///     V c[..][blocks];                  x(t + s unit) = sum of c[k] s^k, k = 0 .. order
///     V rate[blocks];                   dx/dt, from `begin`
///     void begin(double t, const V* x); the rate at a state
///     void expand(double unit);         c[1] .. c[order] at the state c[0]
///     bool prepared;                    `expand` needs `begin` before it, at the same state
///   };
///
/// whose numbers may be static constants: then the loops over registers are written out.
///
/// The unit of time is a power of two near the step, so coefficients of any order stay near the
/// size of the state whatever the scales of state and time are.
namespace taylor {

template <class Series>
class March {
  using V = typename Series::V;
  static constexpr int width = sizeof(V) / sizeof(double);
  static constexpr int most_blocks = Series::room, room = most_blocks * width;
  using Policy = StepPolicy;
  /// Of the time at the start, the least first guess of a step.
  static constexpr double kLeastGuess = 0x1p-40;

 public:
  March(const casimir_run* run, Series& series, double* x, casimir_outcome* out)
      : run_(run),
        series_(series),
        x_(x),
        out_(out),
        leading_(run->leading && run->leading->from == 0 ? run->leading : nullptr),
        choice_(run, series, leading_),
        span_(run->t_end - run->t_begin),
        pace_(run->t_begin) {}

  void go() {
    if (!start()) return finish();
    while (status_ == CASIMIR_OK && !there_) {
      if (run_->max_steps && steps_ + rejected_ >= run_->max_steps) {
        status_ = CASIMIR_MAX_STEPS;
        break;
      }
      if (pieces_ == 0 && !run_->max_steps && pace_.hopeless(steps_ + rejected_, t_, run_->t_end)) {
        status_ = CASIMIR_STEP_UNDERFLOW;
        if (has_shrunk(unit_, t_ - run_->t_begin, steps_)) fail(CASIMIR_STEP_UNDERFLOW);
        break;
      }
      CASIMIR_UNROLL
      for (int b = 0; b < series_.blocks; ++b) series_.c[0][b] = state_[b];
      if (series_.prepared && series_.smooth) series_.begin(t_, state_);
      series_.expand(unit_);
      ++expansions_;
      double s = chosen_step();
      if (__builtin_expect(!(s > 0), 0)) {
        shrink_unit();
        continue;
      }
      while (!attempt(s)) {
        if (!reject(s)) break;
      }
    }
    finish();
  }

 private:
  bool start() {
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) state_[b] = carry_[b] = V{};
    for (int i = 0; i < series_.states; ++i) state_[i / width][i % width] = x_[i];
    t_ = run_->t_begin;
    status_ = CASIMIR_NON_FINITE;
    if (!finite(state_) || !__builtin_isfinite(span_)) return false;
    status_ = CASIMIR_OK;
    there_ = span_ == 0;
    if (there_) return false;
    series_.begin(t_, state_);
    if (!finite(series_.rate)) {
      status_ = CASIMIR_NON_FINITE;
      return false;
    }
    return run_->fixed_step > 0 ? start_fixed() : start_free();
  }

  bool start_free() {
    double size = run_->atol, speed = 0;
    for (int i = 0; i < series_.states; ++i) {
      size = larger(size, magnitude(x_[i]));
      speed = larger(speed, magnitude(series_.rate[i / width][i % width]));
    }
    // The solution's own time scale; a guess, which the coefficients correct.
    double guess = magnitude(span_);
    if (speed > 0 && size / speed < guess) guess = size / speed;
    // A start at zero says nothing of the scale, but the time has its own rounding.
    guess = larger(guess, kLeastGuess * magnitude(run_->t_begin));
    if (run_->first_step > 0) guess = run_->first_step;
    set_unit(guess);
    fresh_ = true;
    return true;
  }

  bool start_fixed() {
    pieces_ = __builtin_ceil(magnitude(span_) / run_->fixed_step * (1 - 4 * kEpsilon));
    pieces_ = larger(pieces_, 1);
    if (!(pieces_ < 0x1p53)) status_ = CASIMIR_STEP_UNDERFLOW;
    set_unit(magnitude(span_) / pieces_);
    double scale = 0;
    for (int i = 0; i < series_.states; ++i) scale = larger(scale, magnitude(x_[i]));
    choice_.fix(scale);
    return status_ == CASIMIR_OK;
  }

  void set_unit(double h) {
    unit_ = power_of_two_near(h);
    if (span_ < 0) unit_ = -unit_;
  }

  CASIMIR_INLINE bool finite(const V* x) const {
    V zero = V{};
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) zero += x[b] * 0;
    return lane_sum(zero) == 0;
  }

  /// The step in units, or 0 where the coefficients are no numbers.
  CASIMIR_INLINE double chosen_step() {
    const auto sizes = choice_.measure();
    if (!(sizes.before + sizes.last < Policy::kNoNumber)) return 0;
    return pieces_ > 0 ? fixed_step(sizes.last) : choice_.length(sizes);
  }

  const auto& continuation() const { return choice_.continuation(); }

  /// What the series adds to the state after s units.
  CASIMIR_INLINE void gain_after(double s, V* sum) const {
    increment(series_, s, sum);
    if (continuation().used()) continuation().add(series_.order, series_.blocks, s, sum);
  }

  double fixed_step(double last) {
    const double h = span_ / pieces_, s = h / unit_;
    // Without error control, but not beyond all meaning: the last term reaches the state itself.
    for (int k = 0; k < series_.order; ++k) last *= s;
    if (!(last < 1)) fail(CASIMIR_NO_CONVERGENCE);
    return s;
  }

  /// A step of s units: whether it was taken.
  CASIMIR_INLINE bool attempt(double s) {
    if (status_ != CASIMIR_OK) return true;
    double h = s * unit_;
    double t1 = t_, t1_carry = t_carry_;
    if (pieces_ > 0) {
      there_ = static_cast<double>(steps_ + 1) >= pieces_;
      t1 = run_->t_begin + static_cast<double>(steps_ + 1) * (span_ / pieces_);
    } else {
      const double rest = (run_->t_end - t_) - t_carry_;
      there_ = magnitude(rest) <= magnitude(h);
      if (there_) {
        h = rest;
        s = h / unit_;
      } else if (magnitude(h) <= larger(Policy::kLeastRoundings * kEpsilon * magnitude(t_),
                                        Policy::kLeastRoundings * kSmallest)) {
        fail(CASIMIR_STEP_UNDERFLOW);
        return true;
      }
      add_carried(t1, t1_carry, h);
    }
    if (there_) t1 = run_->t_end;
    V next[most_blocks], next_carry[most_blocks];
    if (!(__builtin_expect(leading_ != nullptr, 0) &&
          step_with_leading_terms(s, next, next_carry))) {
      V sum[most_blocks];
      gain_after(s, sum);
      CASIMIR_UNROLL
      for (int b = 0; b < series_.blocks; ++b) {
        next[b] = state_[b];
        next_carry[b] = carry_[b];
        add_carried(next[b], next_carry[b], sum[b]);
      }
    }
    if (__builtin_expect(!finite(next), 0)) {
      failure_ = CASIMIR_NON_FINITE;
      return false;
    }
    if (__builtin_expect(run_->project != nullptr, 0)) project(t1, next, next_carry);
    const bool was_cut = cut_;
    if (__builtin_expect(run_->look != nullptr, 0) && pieces_ == 0) {
      if (!looks_right(t1, next)) return false;
    }
    if (!series_.smooth || __builtin_expect(fresh_ || s > Policy::kUnseen, 0)) {
      if (!follows(s, t1, next)) return false;
    }
    accept(t1, t1_carry, next, next_carry);
    cut_ = false;
    // A step that was cut short says nothing about the next one.
    if (!(magnitude(s - Policy::kUsual) < Policy::kAround) && pieces_ == 0 && !was_cut)
      set_unit(magnitude(h));
    return true;
  }

  /// Whether the step may be taken; if not, what part of it is to be tried next.
  __attribute__((noinline)) bool looks_right(double t1, const V* next) {
    double x0[room], x1[room];
    const casimir_step trial = seen(t1, next, x0, x1);
    const double part = run_->look(run_->looker, &trial);
    jumps_ = part > 1;
    if (part >= 1) return true;
    part_ = part;
    cut_ = true;
    failure_ = CASIMIR_STEP_UNDERFLOW;
    return false;
  }

  /// Where the state is far from zero a step changes it by as much as itself, and a carry alone
  /// saves nothing: then it is the leading terms that round. False where they are no numbers, as
  /// where a few digits more make a radicand negative.
  __attribute__((noinline)) bool step_with_leading_terms(double s, V* next, V* next_carry) {
    V rest[most_blocks];
    tail(series_, s, rest);
    if (continuation().used()) {
      V more[most_blocks] = {};
      continuation().add(series_.order, series_.blocks, s, more);
      // The rest begins with the coefficient of s^3.
      for (int b = 0; b < series_.blocks; ++b) rest[b] += more[b] / (s * s * s);
    }
    for (int b = 0; b < series_.blocks; ++b) {
      next[b] = state_[b];
      next_carry[b] = carry_[b];
    }
    leading_->add(leading_->object, t_, unit_, s, reinterpret_cast<double*>(next),
                  reinterpret_cast<double*>(next_carry), reinterpret_cast<const double*>(rest));
    return finite(next);
  }

  __attribute__((cold, noinline)) void project(double t1, V* next, V* next_carry) {
    double x[room], carry[room];
    for (int i = 0; i < series_.states; ++i) {
      x[i] = next[i / width][i % width];
      carry[i] = next_carry[i / width][i % width];
    }
    run_->project(run_->projector, t1, x, carry);
    for (int i = 0; i < series_.states; ++i) {
      next[i / width][i % width] = x[i];
      next_carry[i / width][i % width] = carry[i];
    }
  }

  /// Whether the series has the derivative that the equations ask for, within the step and at its
  /// end. The last coefficients alone do not show a kink of the right-hand side, nor terms that are
  /// missing only from them, and a pulse may have passed before the end.
  __attribute__((noinline)) bool follows(double s, double t1, const V* next) {
    const int places = fresh_ || s > Policy::kUnseen ? Policy::kPlacesAtFirst : Policy::kPlaces;
    // What the unit would make of the state is nothing to a step that was cut to a tiny part of it.
    if (__builtin_expect(s < Policy::kPartOfUnit, 0)) choice_.weigh(s);
    for (int i = 0; i < places; ++i) {
      place_ += Policy::kGoldenSection;
      if (place_ >= 1) place_ -= 1;
      const double within = s * Policy::place(i, places, place_);
      V x[most_blocks];
      gain_after(within, x);
      CASIMIR_UNROLL
      for (int b = 0; b < series_.blocks; ++b) x[b] = state_[b] + x[b];
      if (!follows_at(within, t_ + within * unit_, x)) return false;
    }
    // Last, since what begins at the end is the next step.
    if (!follows_at(s, t1, next) && !jumps_) return false;
    fresh_ = false;
    return true;
  }

  CASIMIR_INLINE bool follows_at(double s, double t, const V* next) {
    V told[most_blocks], defect = V{};
    slope(series_, s, told);
    if (continuation().used()) continuation().add_slope(series_.order, series_.blocks, s, told);
    series_.begin(t, next);
    ++evaluations_;
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) {
      const V size = absolute(state_[b]) + absolute(next[b]) + absolute(told[b]);
      const V w = 1 / (Policy::kDefect / choice_.weight(b) + size * Policy::kRounding);
      defect += absolute(series_.rate[b] * (s * unit_) - told[b]) * w;
    }
    const double sum = lane_sum(defect);
    failure_ = sum < Policy::kNoNumber ? CASIMIR_STEP_UNDERFLOW : CASIMIR_NON_FINITE;
    return sum < 1 || (sum < Policy::kNoNumber && (pieces_ > 0 || is_rounding(s, t, next, told)));
  }

  /// Whether the defect is what rounding makes of the right-hand side there. Leaves the series as
  /// it was.
  __attribute__((cold, noinline)) bool is_rounding(double s, double t, const V* next,
                                                   const V* told) {
    V rate[most_blocks], moved[most_blocks], defect = V{};
    for (int b = 0; b < series_.blocks; ++b) {
      rate[b] = series_.rate[b];
      moved[b] = next[b] + next[b] * Policy::kNudgeOfStates;
    }
    series_.begin(t + t * Policy::kNudgeOfTime, moved);
    evaluations_ += 2;
    const double h = s * unit_;
    for (int b = 0; b < series_.blocks; ++b) {
      const V size = absolute(state_[b]) + absolute(next[b]) + absolute(told[b]);
      const V noise = absolute((series_.rate[b] - rate[b]) * h);
      const V w = 1 / (Policy::kDefect / choice_.weight(b) + size * Policy::kRounding + noise);
      defect += absolute(rate[b] * h - told[b]) * w;
    }
    series_.begin(t, next);
    return lane_sum(defect) < 1;
  }

  CASIMIR_INLINE void accept(double t1, double t1_carry, const V* next, const V* next_carry) {
    if (__builtin_expect(++steps_ == Policy::kStepsToJudge && run_->leading, 0)) judge_length(t1);
    if (__builtin_expect(run_->observe != nullptr, 0)) {
      show(t1, next);
    }
    t_ = t1;
    t_carry_ = t1_carry;
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) {
      state_[b] = next[b];
      carry_[b] = next_carry[b];
    }
  }

  /// Whether the run is so long that the rounding of its steps adds up.
  __attribute__((cold, noinline)) void judge_length(double t1) {
    const double expected = static_cast<double>(steps_) * (span_ / (t1 - run_->t_begin));
    if (leading_ || !(expected >= static_cast<double>(run_->leading->from)) || pieces_ > 0) return;
    leading_ = run_->leading;
    choice_.continue_no_more();
    choice_.aim_at(run_, true);
  }

  __attribute__((cold, noinline)) void show(double t1, const V* next) {
    double x0[room], x1[room];
    const casimir_step step = seen(t1, next, x0, x1);
    if (run_->observe(run_->observer, &step) && !there_) status_ = CASIMIR_STOPPED;
  }

  /// The step as others see it, in their arrays.
  CASIMIR_INLINE casimir_step seen(double t1, const V* next, double* x0, double* x1) const {
    for (int i = 0; i < series_.states; ++i) {
      x0[i] = state_[i / width][i % width];
      x1[i] = next[i / width][i % width];
    }
    return {t_, t1, x0, x1, &dense, this, nullptr, nullptr};
  }

  __attribute__((cold)) static void dense(const casimir_step* step, double t, double* at) {
    const March* self = static_cast<const March*>(step->data);
    V sum[most_blocks];
    self->gain_after((t - step->t0) / self->unit_, sum);
    for (int i = 0; i < self->series_.states; ++i) at[i] = step->x0[i] + sum[i / width][i % width];
  }

  /// After a trial that did not hold: a part of the step, or the end. Whether to try again.
  __attribute__((cold, noinline)) bool reject(double& s) {
    ++rejected_;
    there_ = false;
    if (pieces_ > 0) {
      fail(failure_ == CASIMIR_NON_FINITE ? CASIMIR_NON_FINITE : CASIMIR_NO_CONVERGENCE);
      return false;
    }
    if (run_->max_steps && steps_ + rejected_ >= run_->max_steps) {
      status_ = CASIMIR_MAX_STEPS;
      return false;
    }
    const double rest = magnitude((run_->t_end - t_) - t_carry_) / magnitude(unit_);
    s = (s < rest ? s : rest) * part_;
    part_ = Policy::kShorter;
    return true;
  }

  /// The coefficients left the range of numbers: a smaller unit, or the end.
  __attribute__((cold, noinline)) void shrink_unit() {
    if (status_ != CASIMIR_OK) return;
    ++rejected_;
    unit_ *= Policy::kSmallerUnit;
    failure_ = CASIMIR_NON_FINITE;
    const bool vanished =
        magnitude(unit_) <= larger(kEpsilon * magnitude(t_), 0x1p-1000) || pieces_ > 0;
    if (vanished || creeps()) fail(CASIMIR_NON_FINITE);
  }

  /// Whether the coefficients leave the range of numbers every few steps.
  bool creeps() {
    const double shrunk = static_cast<double>(++shrunk_);
    return shrunk > Policy::kOftenShrunk &&
           Policy::kEveryFew * shrunk > static_cast<double>(steps_);
  }

  __attribute__((cold, noinline)) void fail(int failure) {
    double x[room] = {}, f[room] = {};
    series_.begin(t_, state_);
    for (int i = 0; i < series_.states; ++i) {
      x[i] = state_[i / width][i % width];
      f[i] = series_.rate[i / width][i % width];
    }
    there_ = false;
    if (failure == CASIMIR_STEP_UNDERFLOW && failure_ != CASIMIR_OK) failure = failure_;
    status_ = status_of_vanished_step<room>(t_ - run_->t_begin, x, f, failure);
  }

  void finish() {
    for (int i = 0; i < series_.states; ++i) x_[i] = state_[i / width][i % width];
    out_->status = status_;
    out_->t = t_;
    out_->steps = steps_;
    out_->rejected = rejected_;
    out_->evaluations = expansions_ * static_cast<unsigned long long>(series_.order) + evaluations_;
    out_->jacobians = 0;
  }

  const casimir_run* run_;
  Series& series_;
  double* x_;
  casimir_outcome* out_;
  const casimir_leading* leading_;  // as soon as it is worth its time
  StepChoice<Series> choice_;
  V state_[most_blocks], carry_[most_blocks];
  double t_ = 0, t_carry_ = 0;
  const double span_;
  Pace pace_;
  double unit_ = 1, pieces_ = 0;
  unsigned long long steps_ = 0, rejected_ = 0, expansions_ = 0, evaluations_ = 0;
  unsigned long long shrunk_ = 0;  // units
  int status_ = CASIMIR_OK, failure_ = CASIMIR_OK;
  bool there_ = false, fresh_ = false, cut_ = false, jumps_ = false;
  double part_ = Policy::kShorter;  // of a step that did not hold, what is tried next
  double place_ = 0.5;              // within a step, where it was looked at last
};

/// The order at which the tolerance of a run costs least.
/// \param large  so many products that they take the time.
inline int order_for(const casimir_run* run, bool large = false) {
  const double tolerance = run->fixed_step > 0 ? 0 : run->rtol;
  return large ? order_of_large(tolerance) : order_of_one(tolerance);
}

}  // namespace taylor

}  // namespace casimir_kernel
