#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "symbolic/discrete/map_case.hpp"
#include "symbolic/discrete/map_model.hpp"
#include "tools/analysis/row.hpp"
#include "tools/cli/cli.hpp"

namespace casimir::tools {

/// What `integrate` was asked of the case of a map.
struct MapRunRequest {
  const Common& common;
  const MapCaseFile& file;
  std::optional<double> duration;  ///< in steps; without it that of the scene
  std::string output;
  double every = 0;  ///< steps between the states written
};

/// Iterates the map of a scene and reports.
/// \return the exit status
int iterate_map(const MapRunRequest& request);

/// Iterates a scene and compares what the map is said to keep with its first value, at up to a
/// thousand states and at the end: the row of `conserve`.
/// \param duration  in steps; without it that of the scene
/// \param bound  largest drift allowed
/// \throws UsageError, CaseError  for a duration that is no whole number, or for none
Row conserve_map(const MapModel& map, const Scene& scene, const std::optional<double>& duration,
                 double bound, const std::function<bool()>& give_up);

/// "of a map is a whole number of steps": the number that was asked for.
/// \throws UsageError  for what is none
std::uint64_t whole_steps(double value, const std::string& what);

}  // namespace casimir::tools
