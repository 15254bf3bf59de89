// Invariant measures: the density rho satisfies div(rho f) + d(rho)/dt = 0 for the flow f, or for
// the flow of every Hamiltonian, which for rho = 1 is the unimodularity of a Lie algebra
// (Borisov & Mamaev, Sec. 1.2).
#include <fmt/format.h>

#include "symbolic/claims/claim.hpp"

namespace casimir {
namespace {

Residual divergence_of_flow(Prover& prover, const NamedExpression& density) {
  const Polynomial rho = prover.convert(density.value);
  return {fmt::format("the divergence of ({}) * dx/dt", density.name),
          prover.rate(rho) + rho * prover.divergence(), [&prover, density] {
            const Model& model = prover.model();
            GiNaC::ex sum = model.rate(density.value);
            for (std::size_t i = 0; i < model.variables.size(); ++i)
              sum += density.value * model.field[i].diff(model.variables[i]);
            return sum;
          }};
}

/// sum_i d(rho J_ij)/dx_i for each j: what multiplies dH/dx_j in the divergence.
std::vector<Residual> modular_field(Prover& prover, const NamedExpression& density) {
  const Polynomial rho = prover.convert(density.value);
  std::vector<Residual> residuals;
  for (std::size_t j = 0; j < prover.dimension(); ++j) {
    Polynomial sum(prover.ring().ring());
    for (std::size_t i = 0; i < prover.dimension(); ++i)
      sum += prover.ring().derivative(rho * prover.bracket_entry(i, j), i);
    residuals.push_back({fmt::format("the divergence of ({}) * dx/dt for H = {}", density.name,
                                     prover.model().variables[j].get_name()),
                         std::move(sum), [&prover, density, j] {
                           const Model& model = prover.model();
                           GiNaC::ex total = 0;
                           for (std::size_t i = 0; i < model.variables.size(); ++i)
                             total +=
                                 (density.value * (*model.poisson)(i, j)).diff(model.variables[i]);
                           return total;
                         }});
  }
  return residuals;
}

}  // namespace

std::vector<Claim> measure_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const Measure& measure : model.measures) {
    const NamedExpression density = measure.density;
    const bool every = measure.every_hamiltonian;
    claims.push_back({"measure",
                      density.name + (every ? ", every Hamiltonian" : ""),
                      false,
                      [density, every](Prover& prover, Proof& proof) {
                        prover.decide(proof,
                                      every ? modular_field(prover, density)
                                            : std::vector{divergence_of_flow(prover, density)},
                                      {});
                      },
                      {},
                      {density.value}});
  }
  return claims;
}

std::vector<Claim> unimodularity_notes(const Model& model) {
  if (!model.linear_bracket) return {};
  Claim note{"measure", "unimodular algebra", false, [](Prover& prover, Proof& proof) {
               prover.decide(proof, modular_field(prover, {"1", 1, {}}), {});
               if (proof.verdict == Verdict::proved)
                 proof.evidence = "the flow of every Hamiltonian keeps the volume";
             }};
  note.note = true;
  return {note};
}

}  // namespace casimir
