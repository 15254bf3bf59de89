#pragma once

#include <string>

#include "symbolic/case/limits.hpp"
#include "symbolic/model.hpp"

namespace casimir::test {

/// A case of this folder's `cases/`.
inline Model bundled(const std::string& name) {
  return build_model(read_case(CASIMIR_SOURCE_DIR "/cases/" + name + ".toml"));
}

/// A case written in a test.
inline Model model_of(const std::string& toml, const Limits& limits = {}) {
  return build_model(parse_case(toml, "test.toml", limits));
}

/// Euler's top on so(3) with some lines added.
inline Model euler_with(const std::string& more, const Limits& limits = {}) {
  return model_of("hamiltonian = \"(a1*M1^2 + a2*M2^2 + a3*M3^2)/2\"\n" + more +
                      "\n[phase_space]\nvariables = [\"M1\", \"M2\", \"M3\"]\nalgebra = "
                      "\"so(3)\"\n[parameters]\na1 = {}\na2 = {}\na3 = {}\n",
                  limits);
}

}  // namespace casimir::test
