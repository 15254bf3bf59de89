#pragma once

#include "runtime/kernels/one_step/control.hpp"
#include "runtime/kernels/taylor/continuation.hpp"
#include "runtime/kernels/taylor/step_policy.hpp"
#include "runtime/kernels/taylor/sums.hpp"

namespace casimir_kernel::taylor {

/// The part of the tolerance that a step aims at. Truncation errors add up in one direction,
/// rounding errors in all: at the least tolerances truncation shall not be what millions of steps
/// show. It goes out of sight by degrees, so that no tolerance costs much more than the next one.
/// \param leading  whether the leading terms of a step are worked out in more digits.
inline double aim(const casimir_run* run, bool leading) {
  // A hundredth of what rounding a step costs: 25 million steps show more than that. Where the
  // leading terms round like all others, a run shows no more than what is a part of that rounding.
  constexpr double kUnseen = 1e-18, kRounded = 1e-16, kFine = 1e-13, kLeast = 1e-15;
  if (!(run->rtol > 0 && run->rtol < kFine)) return 1;
  if (!leading && run->rtol < kLeast) return run->rtol / kLeast * (kRounded / kLeast);
  // kUnseen at the tolerance kLeast.
  const double lost = run->rtol / kFine, part = lost * __builtin_sqrt(lost);
  return larger(part, (leading ? kUnseen : kRounded) / run->rtol);
}

/// How long the next step of one trajectory is, and what its errors are measured by: the last
/// coefficients, in units of the error that is allowed, and how well they continue.
template <class Series>
class StepChoice {
  using V = typename Series::V;
  using Policy = StepPolicy;

 public:
  /// The last two coefficients, in allowed errors.
  struct Sizes {
    double before, last;
  };

  StepChoice(const casimir_run* run, const Series& series, bool leading)
      : series_(series), most_gained_(most_gained(run->rtol, series.smooth)) {
    aim_at(run, leading);
  }

  /// \param leading  as of `aim`
  void aim_at(const casimir_run* run, bool leading) {
    rtol_ = run->rtol * aim(run, leading);
    atol_ = run->atol * aim(run, leading);
  }

  /// Steps are given: what they may miss is measured by this size of the state.
  void fix(double scale) {
    is_fixed_ = true;
    scale_ = scale;
  }

  /// No step is made longer by continuing the series from here on.
  void continue_no_more() { most_gained_ = 0; }

  /// One over the error allowed to each component, as measured last.
  const V& weight(int b) const { return weight_[b]; }

  /// Measures again, for steps of so many units. A component's size is what it takes during one.
  CASIMIR_INLINE void weigh(double s) {
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) {
      const V size = absolute(series_.c[0][b]) + absolute(series_.c[1][b]) * s +
                     absolute(series_.c[2][b]) * (s * s);
      const V unit = is_fixed_ ? size + scale_ : atol_ + rtol_ * size;
      weight_[b] = 1 / (unit > kSmallest ? unit : all_lanes<V>(kSmallest));
    }
  }

  CASIMIR_INLINE Sizes measure() {
    const int order = series_.order;
    weigh(1);
    V last = V{}, before = V{};
    CASIMIR_UNROLL
    for (int b = 0; b < series_.blocks; ++b) {
      before += absolute(series_.c[order - 1][b]) * weight_[b];
      last += absolute(series_.c[order][b]) * weight_[b];
    }
    return {lane_sum(before), lane_sum(last)};
  }

  /// The step in units at which terms of these sizes are as large as the tolerance allows, or a
  /// longer one where the series is continued.
  CASIMIR_INLINE double length(const Sizes& sizes) {
    const double rate = rate_of(sizes.before, sizes.last);
    if (!(most_gained_ > Policy::kWorthwhile) || rate < Policy::kSteepest) {
      continuation_.forget();
      return rate < Policy::kSteepest ? Policy::kLongest : rough_exp2(-rate);
    }
    return continued_length(rate);
  }

  /// What the series is continued by during this step, if it is.
  const Continuation<V, Series::room>& continuation() const { return continuation_; }

 private:
  static double most_gained(double tolerance, bool smooth) {
    if (!smooth && tolerance > Policy::kFewDigits) return 0;
    const double part = rough_log2(tolerance / Policy::kRounded) *
                        (1 / rough_log2(Policy::kUnaffected / Policy::kRounded));
    constexpr double kLeast = Policy::kLeastGained, kMost = Policy::kMostGained;
    return part > 0 ? kLeast + (kMost - kLeast) * (part < 1 ? part : 1) : kLeast;
  }

  /// log2 of the factor from order to order that makes terms of these sizes out of one of size 1:
  /// the larger one of what the last but one and the last say.
  CASIMIR_INLINE double rate_of(double before, double last) const {
    return larger(rough_log2(before) * (1. / (series_.order - 1)),
                  rough_log2(last) * (1. / series_.order));
  }

  /// The step where the last terms, in units, are as large as this log2 says: a longer one where
  /// the series can be continued. What the last two coefficients miss then takes their place.
  CASIMIR_INLINE double continued_length(double rate) {
    const auto missed = continuation_.fit(series_, weight_);
    const double gain =
        rate - rate_of(missed.before * Policy::kDoubt, missed.last * Policy::kDoubt);
    if (gain > Policy::kWorthwhile) {
      const double s = rough_exp2((gain < most_gained_ ? gain : most_gained_) - rate);
      if (continuation_.use(series_, s)) return s;
      return continuation_.before_zero(rough_exp2(-rate));
    }
    continuation_.forget();
    return rough_exp2(-rate);
  }

  const Series& series_;
  double rtol_ = 0, atol_ = 0;  // aimed at
  double most_gained_;          // by continuing the series, as a log2
  bool is_fixed_ = false;
  double scale_ = 0;
  V weight_[Series::room];
  Continuation<V, Series::room> continuation_;
};

}  // namespace casimir_kernel::taylor
