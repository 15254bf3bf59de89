#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/analysis/run/assessed_run.hpp"

namespace casimir::tools {

/// The interface's keys; null where it is not known.
nlohmann::ordered_json to_json(const ErrorEstimate& trust);

/// Sentences for the user where the result is in doubt.
/// \param constant_step  whether the run has steps of one size, and no tolerance.
std::vector<std::string> warnings_of(const ErrorEstimate& trust, bool constant_step = false);

/// What is said of members with a constant step where `may_pass_over` says so.
inline constexpr const char* kUnseenBetweenSteps =
    "with a constant step nobody looks for what lies between the ends of a step, such as a pulse "
    "or "
    "a wall, and three members at most were checked: without --step each of them looks";

/// What is said of a run beside its numbers.
struct RunWords {
  std::vector<std::string> warnings;
  std::string advice;        ///< where the run stopped early
  bool interrupted = false;  ///< by the user
  /// Whether a warning is about the state at the end, and not about how the run was made or about a
  /// function that is no integral.
  bool end_in_doubt = false;
};

/// \param interrupted  whether the user ended it.
RunWords words_of(const AssessedRun& judged, bool interrupted = false);

}  // namespace casimir::tools
