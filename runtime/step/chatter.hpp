#pragma once

#include <cmath>

namespace casimir {

/// Finds out that a run chatters: thousands of its steps end behind branches, and the time does not
/// move. Fields that point at each other on both sides of a jump hold a solution there that is none
/// of the equations.
class Chatter {
 public:
  /// Asked at each look into a step from that time on: whether, at the pace of the last looks, a
  /// run as long as this one so far would take 10^13 of them.
  bool goes_on(double time) {
    constexpr unsigned kLooks = 4096;
    constexpr double kNothing = 1e-13;
    if (looks_ == 0) since_ = time;
    if (++looks_ < kLooks) return false;
    const bool at_branches = 8 * branches_ > kLooks;
    looks_ = branches_ = 0;
    return at_branches && std::abs(time - since_) < kNothing * kLooks * std::abs(time);
  }
  /// The step is to end behind a branch.
  void cut() { ++branches_; }

 private:
  unsigned looks_ = 0, branches_ = 0;  ///< since that time, and of these cut
  double since_ = 0;
};

}  // namespace casimir
