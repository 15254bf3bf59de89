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

/// Looks for Ctrl-C on behalf of work that runs without Python's lock. Only the thread that made it
/// can see one, as in Python itself; others are told.
class Interrupt {
 public:
  /// Whether Python's signal handlers raised: asked often, looks twenty times in a second.
  bool operator()();
  /// \throws pybind11::error_already_set  where they did. With Python's lock.
  void raise();

 private:
  using Clock = std::chrono::steady_clock;
  std::thread::id owner_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(50);
  std::atomic<bool> raised_ = false;
  std::optional<pybind11::error_already_set> error_;
};

}  // namespace casimir::python
