#pragma once

#include <string>
#include <vector>

#include "symbolic/prove.hpp"

namespace casimir::tools {

/// One of the things that are said below a verdict: "reason" and its words.
struct ProofDetail {
  std::string label, text;
};

/// All that a proof says beside its verdict, its name, its conditions and its evidence, in the
/// order in which people read it: what it gives, why it is not proved, a witness, and where the
/// claim is defined.
std::vector<ProofDetail> details_of(const Proof& proof);

}  // namespace casimir::tools
