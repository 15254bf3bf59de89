// Invariant measures: the density rho satisfies d(rho)/dt + rho div(f) = div(rho f) + drho/dt = 0.
#include <fmt/format.h>

#include "symbolic/claims/claim.hpp"

namespace casimir {

std::vector<Claim> measure_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const NamedExpression& density : model.measures) {
    claims.push_back({"measure", density.name, false, [density](Prover& prover, Proof& proof) {
                        const Polynomial rho = prover.ring().convert(density.value);
                        const Residual residual{
                            fmt::format("the divergence of ({}) * dx/dt", density.name),
                            prover.rate(rho) + rho * prover.divergence(), [&prover, density] {
                              GiNaC::ex sum = prover.rate_by_ginac(density.value);
                              for (std::size_t i = 0; i < prover.dimension(); ++i) {
                                sum += density.value *
                                       prover.model().field[i].diff(prover.model().variables[i]);
                              }
                              return sum;
                            }};
                        prover.decide(proof, {residual}, {});
                      }});
  }
  return claims;
}

}  // namespace casimir
