#pragma once

#include <chrono>
#include <string>

namespace casimir::tools {

/// A bar with an estimate on standard error while something long runs: only where that is a
/// terminal. Gone when the work is done.
class Progress {
 public:
  /// \param wanted  false: shows nothing anyway.
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether there is anybody to see it.
  bool visible() const { return visible_; }

  /// A new piece of work, "kovalevskaya: measuring".
  void begin(const std::string& what);

  /// What of it is being done; the estimate stays that of the whole.
  void name(const std::string& what) { what_ = what; }

  /// Which share of it is done, from 0 to 1. Draws ten times a second at most.
  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double share);

  bool visible_ = false, drawn_once_ = false;
  std::string what_;
  Clock::time_point start_, drawn_;
};

}  // namespace casimir::tools
