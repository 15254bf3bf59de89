#pragma once

#include <optional>
#include <string>

#include "symbolic/discrete/map_case.hpp"
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

}  // namespace casimir::tools
