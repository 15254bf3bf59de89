#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/analysis/sweep/grid.hpp"
#include "tools/analysis/sweep/ranks.hpp"
#include "tools/analysis/sweep/task.hpp"

namespace casimir {

/// Where a sweep is kept, and what ends it.
struct SweepOptions {
  std::string output;
  bool restart = false;
  int threads = 0;                     ///< of each rank; 0: all of its processors
  std::function<bool()> give_up = {};  ///< true ends it at the next step of every point
  std::function<void(double share)> progress = {};
};

/// What came of it. In ranks that do not speak only `complete` is set.
struct SweepOutcome {
  std::vector<PointResult> rows;  ///< one for each point, if complete
  std::size_t points = 0, resumed = 0, computed = 0;
  bool complete = false;
  std::string journal;  ///< where the points so far are kept, if it is not complete
};

/// Does the task at every point that the journal of the output does not have yet, on all ranks, and
/// keeps each result there as it comes. `finish` is called in the rank that speaks with all of
/// them; only after it has returned is the journal removed.
/// \throws RequestError, EnvironmentError see Journal
SweepOutcome sweep_over(const SweepTask& task, const Ranks& ranks, const SweepOptions& options,
                        const std::function<void(const std::vector<PointResult>&)>& finish);

}  // namespace casimir
