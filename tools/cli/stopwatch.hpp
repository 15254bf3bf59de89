#pragma once

#include <chrono>

namespace casimir::tools {

/// How long something has taken, by a clock that is never set.
class Stopwatch {
 public:
  /// Seconds since this was made.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace casimir::tools
