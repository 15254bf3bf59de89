// Casimir functions: {x_i, C} = 0 for every coordinate, and so {F, C} = 0 for every F.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/certificate_writer.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/theorems.hpp"

namespace casimir {

Claim casimir_claim(const NamedExpression& f, const std::vector<NamedExpression>& on) {
  return {ClaimKind::casimir,
          f.name,
          false,
          [f, on](Prover& prover, Proof& proof) {
            const Polynomial c = prover.convert(f.value);
            std::vector<Residual> residuals;
            for (std::size_t i = 0; i < prover.dimension(); ++i) {
              const GiNaC::symbol x = prover.model().variables[i];
              const GiNaC::ex value = f.value;
              residuals.push_back(
                  {fmt::format("{{{}, {}}}", x.get_name(), f.name),
                   prover.bracket(prover.ring().ring().variable(i), c),
                   [&prover, x, value] { return prover.model().poisson->bracket(x, value); }});
            }
            const Level level = prover.level(on);
            prover.decide(proof, residuals, level);
            if (proof.verdict == Verdict::proved && !level.empty())
              prover.is_smooth_on(proof, level, {f});
            if (proof.verdict == Verdict::proved) prover.say_where_it_jumps(proof, c, true, true);
          },
          names_of(on),
          values_of(on, f),
          false,
          Subject::bracket,
          LevelClaim{f, on}};
}

bool constraints_are_casimirs(Prover& prover) {
  return std::ranges::all_of(prover.model().constraints,
                             [&](const NamedExpression& f) { return is_casimir(prover, f); });
}

bool is_casimir(Prover& prover, const NamedExpression& f) {
  const std::vector<Polynomial>& flow = prover.flow(f.value);
  return std::all_of(flow.begin(), flow.end(),
                     [&](const Polynomial& rate) { return prover.is_zero(rate); });
}

std::vector<Claim> casimir_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const NamedExpression& f : model.casimirs) claims.push_back(casimir_claim(f, {}));
  return claims;
}

void certify_casimir(CertificateWriter& writer, const Statement& statement) {
  const CertificateWriter::Parts p = writer.parts(statement);
  std::vector<std::vector<Polynomial>> all;
  for (std::size_t i = 0; i < writer.dimension(); ++i)
    all.push_back(CertificateWriter::cofactors(writer.flow(i, p.function), p.level));
  CoqFile& file = writer.file();
  file.begin_part(statement.title());
  const std::string name = "casimir_" + coq_name(p.name);
  const CoqFunction f = file.define(name, p.function);
  if (p.level.empty()) {
    file.state_commutes_with_all(name + "_commutes_with_all", f);
    return;
  }
  const std::vector<CoqFunction> level = writer.define_level(name, p.level);
  for (std::size_t i = 0; i < writer.dimension(); ++i)
    file.state_bracket(name + "_commutes_on_its_level_with", i, f, level, all[i]);
}

}  // namespace casimir
