#pragma once

#include "runtime/kernels/lanes/lane_clock.hpp"
#include "runtime/kernels/lanes/lane_step_size.hpp"

namespace casimir_kernel::lanes {

/// Compares trials with the equations: whether the series has the derivative that these ask for.
/// The last coefficients alone show no kink of the right-hand side.
template <class Series>
class Comparison {
  using V = typename Series::V;
  using M = Mask<V>;
  static constexpr int room = Series::room;
  using Policy = taylor::StepPolicy;

 public:
  Comparison(const casimir_ensemble& run, Series& series, const Clock<V>& clock)
      : run_(run), series_(series), clock_(clock) {}

  /// New members, of which no step has been compared yet.
  void enter(M fresh) { checked_ &= ~fresh; }

  /// Where a trial needs no comparison: the right-hand side is a polynomial, the first step was
  /// right, and this one is not so long that it leans on coefficients that it does not see.
  CASIMIR_INLINE M spared(const Trial<V>& trial) const {
    if constexpr (Series::smooth)
      return checked_ & ~(trial.s > Policy::kUnseen);
    else
      return M{};
  }

  /// Where a trial follows the equations, within it and at its end: a pulse may have passed before
  /// that. The places within are those of a member's own count of trials, so that no motion has
  /// the same ones in each and no neighbour matters.
  /// \param x1        the states at its end.
  /// \param trials    how many each member has made.
  /// \param refusals  takes up why it does not.
  __attribute__((noinline)) M follows(M which, const Trial<V>& trial, const V* x1, V trials,
                                      Refusals<V>& refusals) {
    const int places = Series::smooth ? Policy::kPlacesAtFirst : Policy::kPlaces;
    M good = which;
    for (int i = 0; i < places; ++i) {
      V within;
      for (int lane = 0; lane < width_of<V>; ++lane) {
        const double place = Policy::kGoldenSection * trials[lane];
        const double part = place - static_cast<double>(static_cast<long long>(place));
        within[lane] = trial.s[lane] * Policy::place(i, places, part);
      }
      V x[room];
      each_state(series_, [&](int j) CASIMIR_INLINE_LAMBDA {
        const V* c = series_.row(j);
        V sum = V{};
        for (int k = series_.order; k > 0; --k) sum = (sum + c[k]) * within;
        x[j] = c[0] + sum;
      });
      good &= follows_at(which, within, clock_.time() + within * clock_.unit(), x, refusals);
    }
    // Last, since what begins at the end is the next step.
    good &= follows_at(which, trial.s, trial.t1, x1, refusals) | refusals.jumps;
    checked_ |= good;
    return good;
  }

 private:
  CASIMIR_INLINE M follows_at(M which, V s, V t, const V* x, Refusals<V>& refusals) {
    series_.begin(t, x, rate_);
    const V defect = defect_at(s, x, rate_, nullptr);
    refusals.because(which & (defect < Policy::kNoNumber), CASIMIR_STEP_UNDERFLOW);
    refusals.because(which & ~(defect < Policy::kNoNumber), CASIMIR_NON_FINITE);
    M good = defect < 1;
    if (__builtin_expect(any(which & ~good & (defect < Policy::kNoNumber)), 0))
      good |= is_rounding(s, t, x);
    return good;
  }

  /// How far the series' derivative is from the rate, in what is allowed: all defects together.
  /// \param noise  what rounding makes of each rate; null where it is not known to be more than
  ///               usual
  CASIMIR_INLINE V defect_at(V s, const V* x, const V* rate, const V* noise) {
    const V unit = clock_.unit();
    V defect = V{};
    // What the unit would make of a state is nothing to a step that was cut to a tiny part of it.
    const V part = s < Policy::kPartOfUnit ? s : all_lanes<V>(1);
    for (int i = 0; i < series_.states; ++i) {
      const V* c = series_.row(i);
      V told = V{};
      for (int k = series_.order; k > 0; --k) told = (told + c[k] * k) * s;
      const V size = absolute(c[0]) + absolute(x[i]) + absolute(told);
      V most = Policy::kDefect * allowed(run_, c, part) + size * Policy::kRounding;
      if (noise != nullptr) most += absolute(noise[i] * (s * unit));
      defect += absolute(rate[i] * (s * unit) - told) / most;
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

  const casimir_ensemble& run_;
  Series& series_;
  const Clock<V>& clock_;
  V rate_[room];
  M checked_ = {};  // members of which a step has held
};

}  // namespace casimir_kernel::lanes
