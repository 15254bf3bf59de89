#pragma once

#include <stdexcept>

namespace casimir {

/// Something was asked for that cannot be done: a method or an invariant that is not there,
/// settings that contradict each other, a system that has no such thing. The text says what.
class RequestError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace casimir
