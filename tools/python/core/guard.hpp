#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

namespace casimir::python {

/// While it lives, its thread may use exact algebra, and other threads may run Python. GiNaC and
/// CLN count references without locks, so one thread at a time does, and that includes the end of
/// whatever holds an expression.
class ExactAlgebra {
 public:
  ExactAlgebra();

 private:
  std::optional<pybind11::gil_scoped_release> python_;  ///< where this thread has Python's lock
  std::unique_lock<std::recursive_mutex> lock_;
};

/// Looks for Ctrl-C on behalf of work that runs without Python's lock, and tells Python how far the
/// work is. Only the thread that made it can see and tell, as in Python itself; others are told.
class Interrupt {
 public:
  /// \param progress  None, or a function of the share that is done, from 0 to 1. What it raises ends
  ///                  the work, and is raised there.
  explicit Interrupt(pybind11::object progress = pybind11::none())
      : progress_(std::move(progress)), told_(!progress_.is_none()) {}

  /// Whether anybody wants to be told.
  bool told() const { return told_; }
  /// Called often, tells twenty times in a second.
  void show(double share);
  /// All is done. With Python's lock. \throws pybind11::error_already_set  as `raise` does.
  void finish();
  /// Whether Python's signal handlers raised: asked often, looks twenty times in a second.
  bool operator()();
  /// \throws pybind11::error_already_set  where they did. With Python's lock.
  void raise();

 private:
  using Clock = std::chrono::steady_clock;
  std::thread::id owner_ = std::this_thread::get_id();
  pybind11::object progress_;
  bool told_;
  Clock::time_point next_show_ = Clock::now();
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(50);
  std::atomic<bool> raised_ = false;
  std::optional<pybind11::error_already_set> error_;
};

}  // namespace casimir::python
