#pragma once

#include <string>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/discrete/prove_map.hpp"

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

/// The first proof of the kind, or an undecided one without a reason.
inline Proof proof_of(const MapModel& map, ClaimKind kind, const std::string& name = "") {
  for (const Proof& proof : prove_map(map)) {
    if (proof.kind == kind && (name.empty() || proof.name == name)) return proof;
  }
  return {};
}

inline Verdict verdict_of(const MapModel& map, ClaimKind kind, const std::string& name = "") {
  return proof_of(map, kind, name).verdict;
}

inline const std::string kPhaseSpaceOfPlane = "[phase_space]\nvariables = [\"x\", \"y\"]\n";

}  // namespace casimir::test
