#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace casimir::search {

/// Thrown where the time is up.
class TimeUp : public std::runtime_error {
 public:
  TimeUp() : std::runtime_error("the time limit was reached") {}
};

/// Thrown before anything that would not fit into memory is made; the message has the estimate and
/// what can be done.
class TooMuchMemory : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a search is told by, and tells, those who wait for it.
struct Watch {
  /// Called often with the share that is done of the present step. May throw TimeUp.
  std::function<void(double share)> tick = [](double) {};
  /// Called where a new step begins.
  std::function<void(const std::string& what)> begin = [](const std::string&) {};
  double memory_limit = 2e9;  ///< bytes
};

}  // namespace casimir::search
