#pragma once

#include "runtime/kernels/lanes/lane_estimates.hpp"
#include "runtime/kernels/taylor/taylor.hpp"

namespace casimir_kernel {

/// The method of Taylor series for many trajectories at once, one in each lane of a register.
///
/// Every lane has a time, a step, a unit and a status of its own and takes the next trajectory when
/// its own has ended. A lane computes what `taylor::March` does for one trajectory, by operations
/// that never look into another lane, so what becomes of a trajectory does not depend on where it
/// stood or beside which.
///
/// The coefficients come from a class
///
///   struct Series {
///     using V;                          a register
///     static constexpr int room;        the most states it can have
///     static constexpr bool smooth;     the right-hand side is a polynomial: analytic everywhere
///     static constexpr bool fixed_states;      `states` is a constant
///     int states, order;                order: a multiple of 4. Both may be static
///     V* row(int i);                    row(i)[k]: coefficient k of state i, k = 0 .. order
///     void enter(int lane, const double* numbers);      a new member in this lane
///     void begin(V t, const V* x, V* rate);             dx/dt at a state
///     void expand(V unit);              coefficients 1 .. order at the state in row(i)[0], after
///   };                                  `begin` there (where it is smooth that may be left out)
namespace lanes {

template <class Series>
class March {
  using V = typename Series::V;
  using M = Mask<V>;
  static constexpr int width = width_of<V>, room = Series::room;
  using Policy = taylor::StepPolicy;

 public:
  March(const casimir_ensemble* run, Series& series)
      : run_(run), series_(series), span_(run->t_end - run->t_begin) {
    for (int i = 0; i < series_.states; ++i) {
      series_.row(i)[0] = carry_[i] = V{};
      rows_[i] = reinterpret_cast<const double*>(series_.row(i));
    }
    for (long long& member : member_) member = -1;
  }

  void go() {
    refill();
    while (occupied_ > 0) {
      bool eventful = step();
      if (run_->observe && any(seen_enough_)) {
        end(seen_enough_ & active_, CASIMIR_STOPPED);
        seen_enough_ = M{};
        eventful = true;
      }
      if (eventful && any(ended_)) refill();
      if (run_->give_up && run_->give_up(run_->source)) stop();
    }
  }

 private:
  /// A step of every lane. Whether anything else happened.
  CASIMIR_INLINE bool step() {
    if (!Series::smooth && !ready_) series_.begin(time_, states(), rate_);
    series_.expand(unit_);
    V s = chosen_steps();
    M trying = active_ & (s > 0);
    ready_ = !Series::smooth;
    if (!attempt(s, trying) && !run_->max_steps) return false;
    const M lost = active_ & ~(s > 0);
    if (any(lost)) shrink_units(lost);
    while (any(trying)) {  // those whose trial did not hold
      reject(s, trying);
      attempt(s, trying);
    }
    if (run_->max_steps) limit_steps();
    return true;
  }

  /// The states, beside each other.
  const V* states() {
    for (int i = 0; i < series_.states; ++i) here_[i] = series_.row(i)[0];
    return here_;
  }

  // Members come and go.

  __attribute__((noinline)) void refill() {
    M fresh = {};
    do {
      for (int lane = 0; lane < width; ++lane) {
        if (ended_[lane]) leave(lane);
        if (member_[lane] < 0 && !empty_) fresh[lane] = enter(lane) ? -1 : 0;
      }
      ended_ = M{};
      start(fresh);
      fresh = M{};
    } while (any(ended_));  // members that end where they begin
    ready_ = false;
  }

  bool enter(int lane) {
    double x[room];
    const double* numbers = nullptr;
    const long long member = run_->next(run_->source, x, &numbers);
    empty_ = member < 0;
    if (empty_) return false;
    member_[lane] = member;
    ++occupied_;
    series_.enter(lane, numbers);
    for (int i = 0; i < series_.states; ++i) {
      series_.row(i)[0][lane] = x[i];
      carry_[i][lane] = 0;
    }
    time_[lane] = run_->t_begin;
    time_carry_[lane] = steps_[lane] = rejected_[lane] = shrunk_[lane] = 0;
    part_[lane] = Policy::kShorter;
    cut_[lane] = jumps_[lane] = 0;
    status_[lane] = failure_[lane] = CASIMIR_OK;
    return true;
  }

  /// Reports the member of a lane, which then holds zeros.
  void leave(int lane) {
    double x[room];
    for (int i = 0; i < series_.states; ++i) {
      x[i] = series_.row(i)[0][lane];
      series_.row(i)[0][lane] = 0;
    }
    const double order = series_.order;
    const casimir_outcome out = {
        static_cast<int>(status_[lane]),
        time_[lane],
        static_cast<unsigned long long>(steps_[lane]),
        static_cast<unsigned long long>(rejected_[lane]),
        static_cast<unsigned long long>((steps_[lane] + rejected_[lane]) * order),
        0};
    run_->done(run_->source, member_[lane], x, &out);
    member_[lane] = -1;
    unit_[lane] = 0;
    time_[lane] = run_->t_begin;
    --occupied_;
  }

  /// Rates, and a first guess of the unit of time, for the lanes of a mask.
  void start(M fresh) {
    if (!any(fresh)) return;
    active_ |= fresh;
    series_.begin(time_, states(), rate_);
    V size = all_lanes<V>(run_->atol), speed = V{}, zero = V{};
    for (int i = 0; i < series_.states; ++i) {
      size = larger_of(size, absolute(here_[i]));
      speed = larger_of(speed, absolute(rate_[i]));
      zero += here_[i] * 0 + rate_[i] * 0;
    }
    const V whole = all_lanes<V>(magnitude(span_));
    // The solution's own time scale; a guess, which the coefficients correct.
    const V scale = size / (speed > 0 ? speed : all_lanes<V>(1));
    const V guess = ((speed > 0) & (scale < whole)) ? scale : whole;
    unit_ = fresh ? towards_end(power_of_two_near(guess)) : unit_;
    checked_ &= ~fresh;
    end(fresh & ~(zero == 0), CASIMIR_NON_FINITE);
    if (!__builtin_isfinite(span_)) end(fresh & active_, CASIMIR_NON_FINITE);
    if (span_ == 0) end(fresh & active_, CASIMIR_OK);
  }

  V towards_end(V positive) const { return span_ < 0 ? -positive : positive; }

  void end(M which, int status) {
    status_ = which ? all_lanes<V>(status) : status_;
    ended_ |= which;
    active_ &= ~which;
  }

  void limit_steps() {
    const double most = static_cast<double>(run_->max_steps);
    end(active_ & (steps_ + rejected_ >= most), CASIMIR_MAX_STEPS);
  }

  __attribute__((cold, noinline)) void stop() {
    empty_ = true;
    end(active_, CASIMIR_STOPPED);
    refill();
  }

  // One step.

  /// For each state; written out where their number is known.
  template <class Action>
  CASIMIR_INLINE void each_state(Action action) {
    if constexpr (Series::fixed_states) {
      CASIMIR_UNROLL
      for (int i = 0; i < Series::states; ++i) action(i);
    } else {
      for (int i = 0; i < series_.states; ++i) action(i);
    }
  }

  /// The error allowed to state i, whose size is what it takes during a step of so many units.
  CASIMIR_INLINE V allowed(int i, V s = all_lanes<V>(1)) {
    const V* c = series_.row(i);
    const V size = absolute(c[0]) + (absolute(c[1]) + absolute(c[2]) * s) * s;
    return larger_of(run_->atol + run_->rtol * size, all_lanes<V>(0x1p-1000));
  }

  /// The steps in units at which the last two terms are as large as the tolerance allows, or 0
  /// where the coefficients are no numbers.
  CASIMIR_INLINE V chosen_steps() {
    const int order = series_.order;
    V a = V{}, z = V{};
    each_state([&](int i) CASIMIR_INLINE_LAMBDA {
      const V* c = series_.row(i);
      const V weight = rough_inverse(allowed(i));
      a += absolute(c[order - 1]) * weight;
      z += absolute(c[order]) * weight;
    });
    const V rate =
        larger_of(lanes::rough_log2(a) * (1. / (order - 1)), lanes::rough_log2(z) * (1. / order));
    const V s =
        rate < Policy::kSteepest ? all_lanes<V>(Policy::kLongest) : lanes::rough_exp2(-rate);
    return a + z < Policy::kNoNumber ? s : V{};
  }

  /// A trial step in all lanes.
  struct Trial {
    V s, h, t1, t1_carry;
    M there, vanished, good;
  };

  CASIMIR_INLINE Trial tried(V s) {
    Trial trial;
    V h = s * unit_;
    const V rest = (run_->t_end - time_) - time_carry_;
    trial.there = absolute(rest) <= absolute(h);
    trial.t1 = time_;
    trial.t1_carry = time_carry_;
    const V least = larger_of(Policy::kLeastRoundings * kEpsilon * absolute(time_),
                              all_lanes<V>(Policy::kLeastRoundings * kSmallest));
    trial.vanished = ~trial.there & (absolute(h) <= least);
    if (__builtin_expect(any(trial.there), 0)) {
      h = trial.there ? rest : h;
      s = trial.there ? h / unit_ : s;
    }
    add(trial.t1, trial.t1_carry, h);
    trial.t1 = trial.there ? all_lanes<V>(run_->t_end) : trial.t1;
    trial.s = s;
    trial.h = h;
    trial.good = next_states(s);
    return trial;
  }

  /// Tries steps of s units in the lanes of a mask; leaves those in it whose trial does not hold.
  /// Whether anything happened that is not just another step of every lane.
  CASIMIR_INLINE bool attempt(V s, M& trying) {
    const Trial trial = tried(s);
    if constexpr (Series::smooth) {
      const M plain = trying & trial.good & checked_ & ~(trial.s > Policy::kUnseen) & ~trial.there &
                      ~trial.vanished;
      if (__builtin_expect(!any(active_ & ~plain), 1)) {
        accept(plain, trial);
        trying = M{};
        return false;
      }
    }
    examine(trial, trying);
    return true;
  }

  __attribute__((noinline)) void examine(const Trial& trial, M& trying) {
    const M vanished = trying & trial.vanished;
    if (any(vanished)) {
      fail(vanished, CASIMIR_STEP_UNDERFLOW);
      trying &= ~vanished;
    }
    failure_ = trying & ~trial.good ? all_lanes<V>(CASIMIR_NON_FINITE) : failure_;
    M held = trying & trial.good;
    if constexpr (!Series::smooth)
      if (run_->look) look(held, trial);
    M unsure = held;
    if constexpr (Series::smooth) unsure &= ~checked_ | (trial.s > Policy::kUnseen);
    if (any(unsure)) {
      const M good = follows(unsure, trial);
      checked_ |= unsure & good;
      held &= ~unsure | good;
    }
    accept(held, trial);
    end(held & trial.there, CASIMIR_OK);
    ready_ = ready_ && !any(active_ & ~held);
    trying &= ~held;
  }

  /// Leaves those in a mask whose step may be taken; of the others, what part is to be tried next.
  __attribute__((noinline)) void look(M& held, const Trial& trial) {
    const M asked = held;
    const casimir_lane_step step = shown(asked, trial, nullptr);
    double parts[width];
    run_->look(run_->source, &step, parts);
    for (int lane = 0; lane < width; ++lane) {
      if (!asked[lane]) continue;
      const double part = parts[lane];
      jumps_[lane] = part > 1 ? -1 : 0;
      if (part >= 1) continue;
      held[lane] = 0;
      part_[lane] = part;
      cut_[lane] = -1;
      failure_[lane] = CASIMIR_STEP_UNDERFLOW;
    }
  }

  /// The step as others see it.
  CASIMIR_INLINE casimir_lane_step shown(const M& held, const Trial& trial, M* finished) const {
    return {width,
            series_.states,
            series_.order,
            rows_,
            reinterpret_cast<const double*>(&time_),
            reinterpret_cast<const double*>(&unit_),
            reinterpret_cast<const double*>(&trial.s),
            member_,
            reinterpret_cast<const long long*>(&held),
            reinterpret_cast<long long*>(finished)};
  }

  /// total + carry becomes total + carry + increment, in all lanes.
  static CASIMIR_INLINE void add(V& total, V& carry, V increment) {
    const V y = increment + carry;
    const V sum = total + y;
    const V part = sum - total;
    carry = (total - (sum - part)) + (y - part);
    total = sum;
  }

  /// next_ = the state after s units, summed in four chains; where that is finite. The product with
  /// s and the sum with the carry stand in one place: whether they are fused must not depend on how
  /// the loop is compiled.
  CASIMIR_INLINE M next_states(V s) {
    const V s2 = s * s, s4 = s2 * s2;
    V zero = V{};
    each_state([&](int i) CASIMIR_INLINE_LAMBDA {
      const V* c = series_.row(i) + series_.order - 3;
      V p0 = c[0], p1 = c[1], p2 = c[2], p3 = c[3];
      for (int k = series_.order - 4; k > 0; k -= 4) {
        c -= 4;
        p0 = p0 * s4 + c[0];
        p1 = p1 * s4 + c[1];
        p2 = p2 * s4 + c[2];
        p3 = p3 * s4 + c[3];
      }
      V x = c[-1], carry = carry_[i];
      add(x, carry, ((p0 + p1 * s) + (p2 + p3 * s) * s2) * s);
      next_[i] = x;
      next_carry_[i] = carry;
      zero += x * 0;
    });
    return zero == 0;
  }

  CASIMIR_INLINE void accept(M held, const Trial& trial) {
    if (__builtin_expect(run_->observe != nullptr, 0)) observe(held, trial);
    time_ = held ? trial.t1 : time_;
    time_carry_ = held ? trial.t1_carry : time_carry_;
    steps_ += held ? all_lanes<V>(1) : V{};
    M resize = held & ~(absolute(trial.s - Policy::kUsual) < Policy::kAround);
    if constexpr (!Series::smooth) {
      resize &= ~cut_;  // a step that was cut short says nothing about the next one
      cut_ &= ~held;
    }
    unit_ = resize ? towards_end(power_of_two_near(absolute(trial.h))) : unit_;
    each_state([&](int i) CASIMIR_INLINE_LAMBDA {
      V& x = series_.row(i)[0];
      x = held ? next_[i] : x;
      carry_[i] = held ? next_carry_[i] : carry_[i];
    });
  }

  /// Shows a step while the rows still hold it. Who has seen enough of a member ends it: in its
  /// next state, unless the step ends it anyway.
  __attribute__((noinline)) void observe(M held, const Trial& trial) {
    M finished = {};
    const casimir_lane_step step = shown(held, trial, &finished);
    run_->observe(run_->source, &step);
    seen_enough_ |= finished & held;
  }

  /// Where the series has the derivative that the equations ask for, within the step and at its
  /// end: the last coefficients alone show no kink of the right-hand side, and a pulse may have
  /// passed before the end. The places within are those of a member's own count of steps, so that
  /// no motion has the same ones in each and no neighbour matters.
  __attribute__((noinline)) M follows(M which, const Trial& trial) {
    const int places = Series::smooth ? Policy::kPlacesAtFirst : Policy::kPlaces;
    M good = which;
    for (int i = 0; i < places; ++i) {
      V within;
      for (int lane = 0; lane < width; ++lane) {
        const double place = Policy::kGoldenSection * (steps_[lane] + rejected_[lane]);
        const double part = place - static_cast<double>(static_cast<long long>(place));
        within[lane] = trial.s[lane] * Policy::place(i, places, part);
      }
      V x[room];
      each_state([&](int j) CASIMIR_INLINE_LAMBDA {
        const V* c = series_.row(j);
        V sum = V{};
        for (int k = series_.order; k > 0; --k) sum = (sum + c[k]) * within;
        x[j] = c[0] + sum;
      });
      good &= follows_at(which, within, time_ + within * unit_, x);
    }
    // Last, since what begins at the end is the next step.
    return good & (follows_at(which, trial.s, trial.t1, next_) | jumps_);
  }

  /// How far the series' derivative is from the rate, in what is allowed: all defects together.
  /// \param noise  what rounding makes of each rate; null where it is not known to be more than
  ///               usual
  CASIMIR_INLINE V defect_at(V s, const V* x, const V* rate, const V* noise) {
    V defect = V{};
    // What the unit would make of a state is nothing to a step that was cut to a tiny part of it.
    const V part = s < Policy::kPartOfUnit ? s : all_lanes<V>(1);
    for (int i = 0; i < series_.states; ++i) {
      const V* c = series_.row(i);
      V told = V{};
      for (int k = series_.order; k > 0; --k) told = (told + c[k] * k) * s;
      const V size = absolute(c[0]) + absolute(x[i]) + absolute(told);
      V most = Policy::kDefect * allowed(i, part) + size * Policy::kRounding;
      if (noise != nullptr) most += absolute(noise[i] * (s * unit_));
      defect += absolute(rate[i] * (s * unit_) - told) / most;
    }
    return defect;
  }

  /// In which lanes the defect is what rounding makes of the right-hand side. Leaves the rates as
  /// they were.
  __attribute__((cold, noinline)) M is_rounding(V s, V t, const V* x) {
    V rate[room], moved[room], noise[room];
    for (int i = 0; i < series_.states; ++i) {
      rate[i] = rate_[i];
      moved[i] = x[i] + x[i] * Policy::kNudgeOfStates;
    }
    series_.begin(t + t * Policy::kNudgeOfTime, moved, rate_);
    for (int i = 0; i < series_.states; ++i) noise[i] = rate_[i] - rate[i];
    series_.begin(t, x, rate_);
    return defect_at(s, x, rate, noise) < 1;
  }

  CASIMIR_INLINE M follows_at(M which, V s, V t, const V* x) {
    series_.begin(t, x, rate_);
    const V defect = defect_at(s, x, rate_, nullptr);
    failure_ = (which & (defect < Policy::kNoNumber))    ? all_lanes<V>(CASIMIR_STEP_UNDERFLOW)
               : (which & ~(defect < Policy::kNoNumber)) ? all_lanes<V>(CASIMIR_NON_FINITE)
                                                         : failure_;
    M good = defect < 1;
    if (__builtin_expect(any(which & ~good & (defect < Policy::kNoNumber)), 0))
      good |= is_rounding(s, t, x);
    return good;
  }

  // What seldom happens.

  /// After trials that did not hold: a part of the step, or the end.
  __attribute__((cold, noinline)) void reject(V& s, M& trying) {
    rejected_ += trying ? all_lanes<V>(1) : V{};
    if (run_->max_steps) {
      limit_steps();
      trying &= active_;
    }
    const V rest = absolute((run_->t_end - time_) - time_carry_) / absolute(unit_);
    s = trying ? (s < rest ? s : rest) * part_ : s;
    part_ = trying ? all_lanes<V>(Policy::kShorter) : part_;
  }

  /// The coefficients left the range of numbers: a smaller unit, or the end.
  __attribute__((cold, noinline)) void shrink_units(M lost) {
    rejected_ += lost ? all_lanes<V>(1) : V{};
    shrunk_ += lost ? all_lanes<V>(1) : V{};
    unit_ = lost ? unit_ * Policy::kSmallerUnit : unit_;
    failure_ = lost ? all_lanes<V>(CASIMIR_NON_FINITE) : failure_;
    const V least = larger_of(kEpsilon * absolute(time_), all_lanes<V>(0x1p-1000));
    const M creeps = (shrunk_ > Policy::kOftenShrunk) & (Policy::kEveryFew * shrunk_ > steps_);
    const M vanished = lost & ((absolute(unit_) <= least) | creeps);
    if (any(vanished)) fail(vanished, CASIMIR_NON_FINITE);
  }

  /// Ends lanes whose step has shrunk to nothing, each for its own reason.
  __attribute__((cold, noinline)) void fail(M which, int failure) {
    series_.begin(time_, states(), rate_);
    ready_ = false;
    for (int lane = 0; lane < width; ++lane) {
      if (!which[lane]) continue;
      double x[room] = {}, f[room] = {};
      for (int i = 0; i < series_.states; ++i) {
        x[i] = here_[i][lane];
        f[i] = rate_[i][lane];
      }
      int reason = failure;
      const int before = static_cast<int>(failure_[lane]);
      if (reason == CASIMIR_STEP_UNDERFLOW && before != CASIMIR_OK) reason = before;
      M alone = {};
      alone[lane] = -1;
      end(alone, status_of_vanished_step<room>(time_[lane] - run_->t_begin, x, f, reason));
    }
  }

  const casimir_ensemble* run_;
  Series& series_;
  const double span_;
  V carry_[room], next_[room], next_carry_[room], rate_[room], here_[room];
  V time_ = {}, time_carry_ = {}, unit_ = {}, steps_ = {}, rejected_ = {}, shrunk_ = {},
    status_ = {}, failure_ = {}, part_ = all_lanes<V>(Policy::kShorter);
  M active_ = {}, ended_ = {}, checked_ = {}, seen_enough_ = {}, cut_ = {}, jumps_ = {};
  long long member_[width];
  const double* rows_[room];
  int occupied_ = 0;
  bool empty_ = false, ready_ = false;
};

/// The order that a run asks for, or the one at which its tolerance costs least.
inline int order_of(const casimir_ensemble* run) {
  const int order = run->order > 0 ? run->order : taylor::order_of_many(run->rtol);
  return order < 24 ? order : 24;
}

}  // namespace lanes
}  // namespace casimir_kernel
