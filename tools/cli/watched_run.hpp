#pragma once

#include <chrono>
#include <functional>

#include "runtime/integrate.hpp"
#include "tools/cli/progress.hpp"

namespace casimir::tools {

/// What a person sees of a run that takes long, and what Ctrl-C does to it: a bar on a terminal
/// from the second second on and, where what the run has so far is worth something, an end at the
/// next step.
class WatchedRun {
 public:
  /// Adds its hooks to the settings; keeps a limit that is there. Lives as long as they are used.
  /// \param show  whether a bar is wanted at all.
  /// \param keeps  whether Ctrl-C shall end the run in order. A second one ends the program.
  WatchedRun(Settings& settings, bool show, bool keeps);
  ~WatchedRun();
  WatchedRun(const WatchedRun&) = delete;
  WatchedRun& operator=(const WatchedRun&) = delete;

  /// Whether Ctrl-C ended the run.
  bool interrupted() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool keeps_;
  Progress progress_;
  Clock::time_point start_ = Clock::now();
  unsigned long long calls_ = 0;
  bool begun_ = false;
};

}  // namespace casimir::tools
