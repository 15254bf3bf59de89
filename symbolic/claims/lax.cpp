// Lax pairs: dL/dt = [L, A] = L A - A L, entry by entry and identically in the spectral parameter.
#include <fmt/format.h>

#include "symbolic/claims/claim.hpp"

namespace casimir {
namespace {

void decide_lax(Prover& prover, Proof& proof, const LaxPair& pair) {
  const unsigned n = pair.l.rows();
  const auto entry = [&](const GiNaC::matrix& m, unsigned i, unsigned j) {
    return prover.ring().convert(m(i, j));
  };
  std::vector<Residual> residuals;
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      Polynomial defect = prover.rate(entry(pair.l, i, j));
      for (unsigned k = 0; k < n; ++k) {
        defect -= entry(pair.l, i, k) * entry(pair.a, k, j);
        defect += entry(pair.a, i, k) * entry(pair.l, k, j);
      }
      residuals.push_back({fmt::format("(dL/dt - [L, A])[{},{}]", i + 1, j + 1), std::move(defect),
                           [&prover, &pair, n, i, j] {
                             GiNaC::ex sum = prover.model().rate(pair.l(i, j));
                             for (unsigned k = 0; k < n; ++k)
                               sum -= pair.l(i, k) * pair.a(k, j) - pair.a(i, k) * pair.l(k, j);
                             return sum;
                           }});
    }
  }
  prover.decide(proof, residuals, {});
}

}  // namespace

std::vector<Claim> lax_claims(const Model& model) {
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < model.lax_pairs.size(); ++i) {
    const std::string name =
        model.lax_pairs.size() == 1 ? "Lax pair" : fmt::format("Lax pair {}", i + 1);
    claims.push_back({"lax", name, false, [i](Prover& prover, Proof& proof) {
                        decide_lax(prover, proof, prover.model().lax_pairs[i]);
                      }});
  }
  return claims;
}

}  // namespace casimir
