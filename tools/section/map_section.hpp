#pragma once

#include <string>
#include <vector>

#include "symbolic/discrete/map_case.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/options/picture_options.hpp"

namespace casimir::tools {

/// What `section` was asked of the case of a map: its orbits themselves, which need no plane.
struct MapSectionRequest {
  const Common& common;
  const MapCaseFile& file;
  std::vector<std::string> pair, labels;  ///< none or two
  std::string seeds;                      ///< a CSV file, or empty
  std::vector<std::string> outputs;       ///< .csv files and pictures
  const PictureOptions& print;
  std::size_t orbits = 40, points = 500;
  bool rotation = false;
  std::string colour;  ///< see `colours_by`
};

/// Follows the orbits, writes and draws them.
/// \return the exit status
int section_of_map(const MapSectionRequest& request);

}  // namespace casimir::tools
