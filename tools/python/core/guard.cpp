#include "tools/python/core/guard.hpp"

namespace casimir::python {
namespace py = pybind11;

namespace {

/// What a signal handler calls may end objects that need the lock, so a thread may take it twice.
std::recursive_mutex& algebra_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

ExactAlgebra::ExactAlgebra() {
  // Python's lock first, or whoever has this one and waits for Python would wait for ever.
  if (PyGILState_Check() != 0) python_.emplace();
  lock_ = std::unique_lock(algebra_mutex());
}

bool Interrupt::operator()() {
  if (raised_) return true;
  if (std::this_thread::get_id() != owner_ || Clock::now() < next_) return false;
  next_ = Clock::now() + std::chrono::milliseconds(50);
  const py::gil_scoped_acquire python;
  if (PyErr_CheckSignals() == 0) return false;
  error_.emplace();
  raised_ = true;
  return true;
}

void Interrupt::show(double share) {
  if (!told_ || raised_ || std::this_thread::get_id() != owner_ || Clock::now() < next_show_)
    return;
  next_show_ = Clock::now() + std::chrono::milliseconds(50);
  const py::gil_scoped_acquire python;
  try {
    progress_(share);
  } catch (py::error_already_set& error) {
    error_.emplace(std::move(error));
    raised_ = true;
  }
}

void Interrupt::finish() {
  raise();
  if (told_) progress_(1.0);
}

void Interrupt::raise() {
  if (!error_) return;
  py::error_already_set error = std::move(*error_);
  error_.reset();
  throw error;
}

}  // namespace casimir::python
