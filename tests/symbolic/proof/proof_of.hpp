#pragma once

#include <gtest/gtest.h>

#include <string>

#include "symbolic/prove.hpp"

namespace casimir::test {

/// The proof of that kind and name; the first of the kind where no name is given.
inline Proof proof_of(const Model& model, const std::string& kind, const std::string& name = "") {
  for (const Proof& proof : prove(model)) {
    if (to_string(proof.kind) == kind && (name.empty() || proof.name == name)) return proof;
  }
  ADD_FAILURE() << "no claim of the kind " << kind << ' ' << name;
  return {};
}

}  // namespace casimir::test
