#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "symbolic/prove.hpp"
#include "tests/symbolic/cases.hpp"

namespace casimir::test {

/// Verdict and conditions of the only claim of a kind.
inline Proof proof_in_case(const std::string& kind, const std::string& text) {
  const Model model = model_of(text);
  for (Proof& proof : prove(model)) {
    if (to_string(proof.kind) == kind) return std::move(proof);
  }
  ADD_FAILURE() << "no claim of the kind " << kind;
  return {};
}

inline std::string equations(const std::string& rest) {
  return "[phase_space]\nvariables = [\"x\",\"y\",\"z\"]\n" + rest;
}

}  // namespace casimir::test
