#pragma once

#include <stdexcept>

#include "tools/analysis/error.hpp"

namespace casimir::tools {

/// Exit statuses, as the interface documents them.
enum Exit : int {
  kDone = 0,
  kFailed = 1,
  kBadInput = 2,
  kUndecided = 3,
  kEnvironment = 4,
  kNotContinued = 5,
  kInterrupted = 130,
};

/// A command line that cannot be carried out.
class UsageError : public RequestError {
  using RequestError::RequestError;
};

/// Something outside this program that does not work: a file that cannot be written, a missing
/// tool.
class SystemError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace casimir::tools
