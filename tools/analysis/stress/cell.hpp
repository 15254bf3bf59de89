#pragma once

#include <optional>
#include <string>

#include "runtime/judgement.hpp"
#include "tools/analysis/stress/scene_truth.hpp"
#include "tools/run_report.hpp"
#include "tools/stress/children.hpp"

namespace casimir::tools {

/// One scene by one method: what `integrate` answered, and what that is worth.
struct StressCell {
  Row row;  ///< `row.failed`: a method of our own is silently wrong
  Judgement verdict = Judgement::unknown;
  bool outside = false;                   ///< the method of another library
  std::optional<double> time_error = {};  ///< relative, of the singular time that a refusal names
};

/// The cell of a run of `integrate --json`.
/// \param asked  the row as far as it is known beforehand.
StressCell cell_of(const Row& asked, bool outside, const SceneTruth& truth, const Reply& reply);

}  // namespace casimir::tools
