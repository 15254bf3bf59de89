#pragma once

#include <string>

#include "symbolic/discrete/map_model.hpp"

namespace casimir::test {

/// A map written in a test.
inline MapModel map_of(const std::string& toml) {
  return build_map_model(std::get<MapCaseFile>(parse_any_case(toml, "test.toml")));
}

/// A map of this repository's `cases/maps/`, with values for some of its parameters.
inline MapModel bundled_map(const std::string& name, const ParameterValues& fixed = {}) {
  return build_map_model(
      std::get<MapCaseFile>(read_any_case(CASIMIR_SOURCE_DIR "/cases/maps/" + name + ".toml")),
      fixed);
}

}  // namespace casimir::test
