#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/judgement.hpp"
#include "tools/analysis/row.hpp"
#include "tools/analysis/stress/scene_truth.hpp"

namespace casimir {

/// What a refusal is worth.
enum class Refusal {
  none,            ///< it is no refusal
  expected,        ///< the motion does not reach the end, and that is what was to be said
  not_applicable,  ///< the method is not defined for the system, and said so before it began
  failed,          ///< there is an end, and the method does not come to it
};

/// "none", "expected", "not_applicable" or "failed".
std::string to_string(Refusal refusal);

/// One scene by one method: what a run answered, and what that is worth.
struct StressCell {
  Row row;  ///< `row.failed`: a method of our own is silently wrong
  Judgement verdict = Judgement::unknown;
  Refusal refusal = Refusal::none;        ///< of which kind, where the verdict is `refused`
  bool outside = false;                   ///< the method of another library
  std::optional<double> time_error = {};  ///< relative, of the singular time that a refusal names
};

/// What came back from a run in a process of its own.
struct StressAnswer {
  /// Whether it answered; if not, why: it took too long and was ended, it said why it does nothing,
  /// it ended without a word.
  enum class Kind { answered, killed, refused, crashed };
  Kind kind = Kind::answered;
  bool says_done = false;      ///< by its exit status
  bool unsuitable = false;     ///< of a refusal: what was asked for does not go with the system
  std::string complaint = {};  ///< of a refusal

  // Of an answer.
  Status status = Status::ok;
  double tolerance = 0, rtol = 0, atol = 0;
  double drift = 0;  ///< the largest of all invariants; not a number if one of them is not
  double seconds = 0, compile_seconds = 0;
  unsigned long long steps = 0, evaluations = 0;
  std::vector<std::pair<std::string, double>> state = {};
  bool warned = false;               ///< that the end state is not to be trusted
  std::string warnings = {};         ///< all of them
  std::optional<double> stopped_at;  ///< where it did not reach the end
  std::string stop_reason = {};
};

/// Judges an answer.
/// \param asked  the row as far as it is known beforehand.
/// \param outside  it is a method of another library.
StressCell cell_of(const Row& asked, bool outside, const SceneReference& truth,
                   const StressAnswer& answer);

}  // namespace casimir
