// The bracket itself: skew symmetry and the Jacobi identity, Borisov & Mamaev (1.8).
#include <fmt/format.h>

#include "symbolic/claims/claim.hpp"

namespace casimir {

std::vector<Claim> skew_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{"skew", "bracket", false, [](Prover& prover, Proof& proof) {
             std::vector<Residual> residuals;
             const PoissonStructure& structure = *prover.model().poisson;
             for (std::size_t i = 0; i < prover.dimension(); ++i) {
               for (std::size_t j = 0; j <= i; ++j) {
                 residuals.push_back(
                     {fmt::format("{{x{0},x{1}}} + {{x{1},x{0}}}", i + 1, j + 1),
                      prover.bracket_entry(i, j) + prover.bracket_entry(j, i),
                      [&structure, i, j] { return structure(i, j) + structure(j, i); }});
               }
             }
             prover.decide(proof, residuals, {});
           }}};
}

namespace {

Polynomial jacobi_defect(Prover& prover, std::size_t i, std::size_t j, std::size_t k) {
  Polynomial sum(prover.ring().ring());
  const std::size_t cyclic[3][3] = {{i, j, k}, {j, k, i}, {k, i, j}};
  for (const auto& [a, b, c] : cyclic) {
    for (std::size_t l = 0; l < prover.dimension(); ++l) {
      if (prover.bracket_entry(a, l).is_zero()) continue;
      sum += prover.bracket_entry(a, l) * prover.ring().derivative(prover.bracket_entry(b, c), l);
    }
  }
  return sum;
}

}  // namespace

std::vector<Claim> jacobi_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{"jacobi", "Jacobi identity", false, [](Prover& prover, Proof& proof) {
             const auto& x = prover.model().variables;
             std::vector<Residual> residuals;
             for (std::size_t i = 0; i < x.size(); ++i) {
               for (std::size_t j = i + 1; j < x.size(); ++j) {
                 for (std::size_t k = j + 1; k < x.size(); ++k) {
                   Polynomial defect = jacobi_defect(prover, i, j, k);
                   if (defect.is_zero()) continue;  // of a hundred thousand nearly all are
                   residuals.push_back({fmt::format("{{{0},{{{1},{2}}}}} + cyclic", x[i].get_name(),
                                                    x[j].get_name(), x[k].get_name()),
                                        std::move(defect), [&prover, i, j, k] {
                                          return prover.model().poisson->jacobi_defect(i, j, k);
                                        }});
                 }
               }
             }
             prover.decide(proof, residuals, {});
           }}};
}

}  // namespace casimir
