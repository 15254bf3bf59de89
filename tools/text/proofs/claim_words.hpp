#pragma once

#include <string>

#include "symbolic/prove.hpp"

namespace casimir::tools {

/// What people read of a kind of claims.
struct ClaimWords {
  ClaimKind kind;
  const char *one, *many;  ///< what a search says that it found: "integral", "integrals"
  /// What a finding of this kind says of the candidate that is judged: "it is a first integral".
  std::string (*finding)(const Proof&);
  const char* heading = nullptr;  ///< of the formulas that a case claims; null where it has none
};

/// The words of each kind.
const ClaimWords& claim_words(ClaimKind kind);

}  // namespace casimir::tools
