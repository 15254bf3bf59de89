#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/run/assessed_run.hpp"

namespace casimir::tools {

/// The interface's keys; null where it is not known.
nlohmann::ordered_json to_json(const ErrorEstimate& trust);

/// Sentences for the user where the result is in doubt.
std::vector<std::string> warnings_of(const ErrorEstimate& trust);

/// What is said of a run beside its numbers.
struct RunWords {
  std::vector<std::string> warnings;
  std::string advice;        ///< where the run stopped early
  bool interrupted = false;  ///< by the user
};

/// \param interrupted  whether the user ended it.
RunWords words_of(const AssessedRun& judged, bool interrupted = false);

}  // namespace casimir::tools
