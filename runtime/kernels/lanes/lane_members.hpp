#pragma once

#include "runtime/kernels/lanes/lane_estimates.hpp"

namespace casimir_kernel::lanes {

/// Who stands in which lane: members of an ensemble, taken one after another from their source and
/// handed back as they end, with what is counted for each.
template <class V>
class Members {
  using M = Mask<V>;
  static constexpr int width = width_of<V>;

 public:
  explicit Members(const casimir_ensemble& run)
      : run_(run), most_steps_(static_cast<double>(run.max_steps)) {
    for (long long& member : member_) member = -1;
  }

  bool any_left() const { return occupied_ > 0; }
  bool any_ended() const { return any(ended_); }
  bool has_ended(int lane) const { return ended_[lane] != 0; }
  bool vacant(int lane) const { return member_[lane] < 0; }
  /// Who goes on.
  CASIMIR_INLINE M active() const { return active_; }
  const long long* numbers() const { return member_; }

  // Coming.

  /// Takes the next member into a vacant lane, if there is one.
  /// \param x        becomes its states.
  /// \param numbers  becomes its numbers, until the next call.
  bool take(int lane, double* x, const double*& numbers) {
    if (empty_) return false;
    const long long member = run_.next(run_.source, x, &numbers);
    empty_ = member < 0;
    if (empty_) return false;
    member_[lane] = member;
    ++occupied_;
    steps_[lane] = rejected_[lane] = 0;
    status_[lane] = CASIMIR_OK;
    return true;
  }

  /// Those that have come begin.
  void begin(M fresh) {
    ended_ = M{};
    active_ |= fresh;
  }

  /// No others are taken.
  void close() { empty_ = true; }

  // On the way.

  CASIMIR_INLINE V steps() const { return steps_; }
  /// Accepted or not.
  CASIMIR_INLINE V trials() const { return steps_ + rejected_; }
  CASIMIR_INLINE void count_steps(M which) { steps_ += which ? all_lanes<V>(1) : V{}; }
  CASIMIR_INLINE void count_rejected(M which) { rejected_ += which ? all_lanes<V>(1) : V{}; }

  /// Ends those that have taken as many steps as a member may.
  void limit_steps() { end(active_ & (trials() >= most_steps_), CASIMIR_MAX_STEPS); }

  /// Of whom enough has been seen: they end with the step that is being taken.
  CASIMIR_INLINE void seen_enough(M which) { seen_enough_ |= which; }

  // Going.

  CASIMIR_INLINE void end(M which, int status) {
    status_ = which ? all_lanes<V>(status) : status_;
    ended_ |= which;
    active_ &= ~which;
  }

  /// Ends those of whom enough has been seen, unless the step has ended them anyway. Whether there
  /// are any.
  bool end_seen() {
    if (!any(seen_enough_)) return false;
    end(seen_enough_ & active_, CASIMIR_STOPPED);
    seen_enough_ = M{};
    return true;
  }

  /// Hands back the member of a lane, which then is vacant.
  void hand_back(int lane, double t, const double* x, int order) {
    const double expansions = steps_[lane] + rejected_[lane];
    const casimir_outcome out = {static_cast<int>(status_[lane]),
                                 t,
                                 static_cast<unsigned long long>(steps_[lane]),
                                 static_cast<unsigned long long>(rejected_[lane]),
                                 static_cast<unsigned long long>(expansions * order),
                                 0};
    run_.done(run_.source, member_[lane], x, &out);
    member_[lane] = -1;
    --occupied_;
  }

 private:
  const casimir_ensemble& run_;
  const double most_steps_;
  V steps_ = {}, rejected_ = {}, status_ = {};
  M active_ = {}, ended_ = {}, seen_enough_ = {};
  long long member_[width];
  int occupied_ = 0;
  bool empty_ = false;  // the source
};

}  // namespace casimir_kernel::lanes
