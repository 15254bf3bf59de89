#pragma once

#include <vector>

#include "symbolic/prove.hpp"

namespace casimir {

/// What became of the claims of a model.
struct Verification {
  Verdict verdict = Verdict::undecided;  ///< the worst among the claims, as `overall` says
  std::vector<Proof> proofs;             ///< claims, facts and notes
};

/// Proves or refutes every claim of a model, and the facts about it.
/// \param seconds  what is not reached by then is undecided and says so; 0: no limit. With a limit
///     the proofs run in a process of their own.
/// \throws ModelError  for a system that has no meaning.
Verification verify(const Model& model, double seconds = 0);

}  // namespace casimir
