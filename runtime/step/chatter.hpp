#pragma once

#include <cmath>

namespace casimir {

/// Finds out that a run chatters: hundreds of its steps end behind branches, and the time does not
/// move. Fields that point at each other on both sides of a jump hold a solution there that is none
/// of the equations.
class Chatter {
 public:
  /// \param looks  after how many looks it is asked whether the time moves
  explicit Chatter(unsigned looks = 4096) : looks_asked_(looks) {}

  /// Asked at each look into a step from that time on: whether, at the pace of the last looks, a
  /// run as long as this one so far would take 10^13 of them.
  bool goes_on(double time) {
    constexpr double kNothing = 1e-13;
    if (looks_ == 0) since_ = time;
    if (++looks_ < looks_asked_) return false;
    const bool at_branches = 8 * branches_ > looks_asked_;
    looks_ = branches_ = 0;
    return at_branches && std::abs(time - since_) < kNothing * looks_asked_ * std::abs(time);
  }
  /// The step is to end behind a branch.
  void cut() { ++branches_; }

 private:
  unsigned looks_asked_;
  unsigned looks_ = 0, branches_ = 0;  ///< since that time, and of these cut
  double since_ = 0;
};

}  // namespace casimir
