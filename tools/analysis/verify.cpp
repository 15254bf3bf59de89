#include "tools/analysis/verify.hpp"

#include "tools/analysis/proof/prove_in_process.hpp"

namespace casimir {

Verification verify(const Model& model, double seconds) {
  Verification result;
  result.proofs = prove_within(seconds, model, {}, {});
  result.verdict = overall(model, result.proofs);
  return result;
}

}  // namespace casimir
