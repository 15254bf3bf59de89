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

void Interrupt::raise() {
  if (!error_) return;
  py::error_already_set error = std::move(*error_);
  error_.reset();
  throw error;
}

}  // namespace casimir::python
