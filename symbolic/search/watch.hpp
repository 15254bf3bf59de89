#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace casimir::search {

/// Thrown where a search ends without an answer; the message has the reason.
class NoAnswer : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown where the time is up.
class TimeUp : public NoAnswer {
 public:
  TimeUp() : NoAnswer("the time limit was reached") {}
};

/// Thrown where the functions of a case grow beyond a limit before the search can begin.
class TooMuchWork : public NoAnswer {
  using NoAnswer::NoAnswer;
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
