#pragma once

#include "runtime/kernels/lanes/lane_clock.hpp"
#include "runtime/kernels/lanes/lane_comparison.hpp"
#include "runtime/kernels/lanes/lane_members.hpp"
#include "runtime/kernels/lanes/lane_onlookers.hpp"
#include "runtime/kernels/lanes/lane_states.hpp"
#include "runtime/kernels/lanes/lane_step_size.hpp"
#include "runtime/kernels/lanes/lane_trial.hpp"

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

/// What happens in which order; how it is done is in the parts, each of which keeps what it needs
/// of every lane. They stand in this one object, so that all of it is found from one address, and
/// what a usual step does in them is written out here.
template <class Series>
class March {
  using V = typename Series::V;
  using M = Mask<V>;
  static constexpr int width = width_of<V>, room = Series::room;
  using Policy = taylor::StepPolicy;

 public:
  March(const casimir_ensemble* run, Series& series)
      : run_(*run),
        series_(series),
        members_(*run),
        clock_(*run),
        states_(series),
        comparison_(*run, series, clock_),
        onlookers_(*run, series, clock_, members_) {}

  void go() {
    refill();
    while (members_.any_left()) {
      bool eventful = step();
      if (run_.observe && members_.end_seen()) eventful = true;
      if (eventful && members_.any_ended()) refill();
      if (run_.give_up && run_.give_up(run_.source)) stop();
    }
  }

 private:
  // Members come and go.

  __attribute__((noinline)) void refill() {
    do {
      M fresh = {};
      for (int lane = 0; lane < width; ++lane) {
        if (members_.has_ended(lane)) leave(lane);
        if (members_.vacant(lane)) fresh[lane] = enter(lane) ? -1 : 0;
      }
      start(fresh);
    } while (members_.any_ended());  // members that end where they begin
    ready_ = false;
  }

  bool enter(int lane) {
    double x[room];
    const double* numbers = nullptr;
    if (!members_.take(lane, x, numbers)) return false;
    series_.enter(lane, numbers);
    states_.enter(series_, lane, x);
    clock_.enter(lane);
    refusals_.enter(lane);
    return true;
  }

  void leave(int lane) {
    double x[room];
    states_.leave(series_, lane, x);
    members_.hand_back(lane, clock_.time()[lane], x, series_.order);
    clock_.leave(lane);
  }

  /// Rates, and a first guess of the unit of time, for the lanes of a mask.
  void start(M fresh) {
    members_.begin(fresh);
    if (!any(fresh)) return;
    const V* const x = begin();
    clock_.set_unit(fresh, own_time_scale(run_, clock_.span(), series_.states, x, rate_));
    comparison_.enter(fresh);
    V zero = V{};
    for (int i = 0; i < series_.states; ++i) zero += x[i] * 0 + rate_[i] * 0;
    members_.end(fresh & ~(zero == 0), CASIMIR_NON_FINITE);
    const M begun = fresh & members_.active();
    if (!__builtin_isfinite(clock_.span())) members_.end(begun, CASIMIR_NON_FINITE);
    if (clock_.span() == 0) members_.end(begun, CASIMIR_OK);
  }

  /// The states, and in `rate_` their rates.
  const V* begin() {
    const V* const x = states_.now(series_);
    series_.begin(clock_.time(), x, rate_);
    return x;
  }

  __attribute__((cold, noinline)) void stop() {
    members_.close();
    members_.end(members_.active(), CASIMIR_STOPPED);
    refill();
  }

  // One step.

  /// A step of every lane. Whether anything else happened.
  CASIMIR_INLINE bool step() {
    if (!Series::smooth && !ready_) begin();
    series_.expand(clock_.unit());
    V s = chosen_steps(run_, series_);
    M trying = members_.active() & (s > 0);
    ready_ = !Series::smooth;
    if (!attempt(s, trying) && !run_.max_steps) return false;
    const M lost = members_.active() & ~(s > 0);
    if (any(lost)) shrink_units(lost);
    while (any(trying)) {  // those whose trial did not hold
      reject(s, trying);
      attempt(s, trying);
    }
    if (run_.max_steps) members_.limit_steps();
    return true;
  }

  /// Tries steps of s units in the lanes of a mask; leaves those in it whose trial does not hold.
  /// Whether anything happened that is not just another step of every lane.
  CASIMIR_INLINE bool attempt(V s, M& trying) {
    Trial<V> trial = clock_.trial(s);
    trial.good = states_.sum(series_, trial.s);
    if constexpr (Series::smooth) {
      const M plain =
          trying & trial.good & comparison_.spared(trial) & ~trial.there & ~trial.vanished;
      if (__builtin_expect(!any(members_.active() & ~plain), 1)) {
        accept(plain, trial);
        trying = M{};
        return false;
      }
    }
    examine(trial, trying);
    return true;
  }

  __attribute__((noinline)) void examine(const Trial<V>& trial, M& trying) {
    const M vanished = trying & trial.vanished;
    if (any(vanished)) {
      fail(vanished, CASIMIR_STEP_UNDERFLOW);
      trying &= ~vanished;
    }
    refusals_.because(trying & ~trial.good, CASIMIR_NON_FINITE);
    M held = trying & trial.good;
    if constexpr (!Series::smooth)
      if (run_.look) onlookers_.look(held, trial, refusals_);
    const M unsure = held & ~comparison_.spared(trial);
    if (any(unsure))
      held &= ~unsure |
              comparison_.follows(unsure, trial, states_.next(), members_.trials(), refusals_);
    accept(held, trial);
    members_.end(held & trial.there, CASIMIR_OK);
    ready_ = ready_ && !any(members_.active() & ~held);
    trying &= ~held;
  }

  CASIMIR_INLINE void accept(M held, const Trial<V>& trial) {
    if (__builtin_expect(run_.observe != nullptr, 0))
      members_.seen_enough(onlookers_.observe(held, trial));
    clock_.accept(held, trial);
    members_.count_steps(held);
    M telling = held;
    if constexpr (!Series::smooth) {
      telling &= ~refusals_.cut;  // a step that was cut short says nothing about the next one
      refusals_.cut &= ~held;
    }
    clock_.follow(telling, trial);
    states_.accept(series_, held);
  }

  // What seldom happens.

  /// After trials that did not hold: a part of the step, or the end.
  __attribute__((cold, noinline)) void reject(V& s, M& trying) {
    members_.count_rejected(trying);
    if (run_.max_steps) {
      members_.limit_steps();
      trying &= members_.active();
    }
    const V rest = absolute(clock_.rest()) / absolute(clock_.unit());
    s = trying ? (s < rest ? s : rest) * refusals_.part : s;
    refusals_.part = trying ? all_lanes<V>(Policy::kShorter) : refusals_.part;
  }

  /// The coefficients left the range of numbers: a smaller unit, or the end.
  __attribute__((cold, noinline)) void shrink_units(M lost) {
    members_.count_rejected(lost);
    refusals_.because(lost, CASIMIR_NON_FINITE);
    const M vanished = clock_.shrink_unit(lost, members_.steps());
    if (any(vanished)) fail(vanished, CASIMIR_NON_FINITE);
  }

  /// Ends lanes whose step has shrunk to nothing, each for its own reason.
  __attribute__((cold, noinline)) void fail(M which, int failure) {
    const V* const here = begin();
    ready_ = false;
    for (int lane = 0; lane < width; ++lane) {
      if (!which[lane]) continue;
      double x[room] = {}, f[room] = {};
      for (int i = 0; i < series_.states; ++i) {
        x[i] = here[i][lane];
        f[i] = rate_[i][lane];
      }
      int reason = failure;
      const int before = static_cast<int>(refusals_.failure[lane]);
      if (reason == CASIMIR_STEP_UNDERFLOW && before != CASIMIR_OK) reason = before;
      M alone = {};
      alone[lane] = -1;
      members_.end(alone, status_of_vanished_step<room>(clock_.elapsed(lane), x, f, reason));
    }
  }

  const casimir_ensemble& run_;
  Series& series_;
  Members<V> members_;
  Clock<V> clock_;
  States<Series> states_;
  Refusals<V> refusals_;
  Comparison<Series> comparison_;
  Onlookers<Series> onlookers_;
  V rate_[room];
  bool ready_ = false;  // the series has the rates of the states
};

}  // namespace lanes
}  // namespace casimir_kernel
