#pragma once

#include "runtime/kernels/carried_sum.hpp"
#include "runtime/kernels/lanes/lane_trial.hpp"
#include "runtime/kernels/one_step/control.hpp"

namespace casimir_kernel::lanes {

/// The time of each lane, summed with a carry, and the unit in which its series count it: a power
/// of two near the step, negative where the run goes back.
template <class V>
class Clock {
  using M = Mask<V>;
  using Policy = taylor::StepPolicy;

 public:
  explicit Clock(const casimir_ensemble& run)
      : begin_(run.t_begin), end_(run.t_end), span_(run.t_end - run.t_begin) {}

  void enter(int lane) {
    time_[lane] = begin_;
    carry_[lane] = shrunk_[lane] = 0;
  }
  void leave(int lane) {
    time_[lane] = begin_;
    unit_[lane] = 0;
  }

  double span() const { return span_; }
  CASIMIR_INLINE const V& time() const { return time_; }
  CASIMIR_INLINE const V& unit() const { return unit_; }
  double elapsed(int lane) const { return time_[lane] - begin_; }
  /// What is left of the run.
  CASIMIR_INLINE V rest() const { return (end_ - time_) - carry_; }

  /// Where steps of s units lead. What they lead to is not known yet.
  CASIMIR_INLINE Trial<V> trial(V s) const {
    Trial<V> trial;
    V h = s * unit_;
    const V left = rest();
    trial.there = absolute(left) <= absolute(h);
    trial.t1 = time_;
    trial.t1_carry = carry_;
    const V least = larger_of(Policy::kLeastRoundings * kEpsilon * absolute(time_),
                              all_lanes<V>(Policy::kLeastRoundings * kSmallest));
    trial.vanished = ~trial.there & (absolute(h) <= least);
    if (__builtin_expect(any(trial.there), 0)) {
      h = trial.there ? left : h;
      s = trial.there ? h / unit_ : s;
    }
    add_carried(trial.t1, trial.t1_carry, h);
    trial.t1 = trial.there ? all_lanes<V>(end_) : trial.t1;
    trial.s = s;
    trial.h = h;
    return trial;
  }

  CASIMIR_INLINE void accept(M held, const Trial<V>& trial) {
    time_ = held ? trial.t1 : time_;
    carry_ = held ? trial.t1_carry : carry_;
  }

  /// The unit follows the step where that has become much longer or shorter.
  CASIMIR_INLINE void follow(M which, const Trial<V>& trial) {
    set_unit(which & ~(absolute(trial.s - Policy::kUsual) < Policy::kAround), absolute(trial.h));
  }

  CASIMIR_INLINE void set_unit(M which, V length) {
    const V power = power_of_two_near(length);
    unit_ = which ? (span_ < 0 ? -power : power) : unit_;
  }

  /// A smaller unit, where the coefficients left the range of numbers.
  /// \return  where that comes to no end.
  M shrink_unit(M lost, V steps) {
    shrunk_ += lost ? all_lanes<V>(1) : V{};
    unit_ = lost ? unit_ * Policy::kSmallerUnit : unit_;
    const V least = larger_of(kEpsilon * absolute(time_), all_lanes<V>(0x1p-1000));
    const M creeps = (shrunk_ > Policy::kOftenShrunk) & (Policy::kEveryFew * shrunk_ > steps);
    return lost & ((absolute(unit_) <= least) | creeps);
  }

 private:
  const double begin_, end_, span_;
  V time_ = {}, carry_ = {}, unit_ = {};
  V shrunk_ = {};  // how often the unit was
};

}  // namespace casimir_kernel::lanes
