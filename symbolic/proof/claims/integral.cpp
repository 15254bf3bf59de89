// First integrals, on the whole phase space or on an invariant level, and invariant relations:
// Borisov & Mamaev, Sec. 1.1, (1.10).
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/certificate_writer.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/theorems.hpp"

namespace casimir {
namespace {

Residual rate_of(Prover& prover, const NamedExpression& f) {
  const GiNaC::ex value = f.value;
  return {fmt::format("d({})/dt", f.name), prover.rate(prover.convert(value)),
          [&prover, value] { return prover.model().rate(value); }};
}

/// Whether it has an angle in it, which jumps at its cut. The rate vanishes on both sides of that;
/// a motion that crosses it finds another value there.
bool has_angle(const GiNaC::ex& value) {
  return std::any_of(value.preorder_begin(), value.preorder_end(), [](const GiNaC::ex& part) {
    if (!GiNaC::is_a<GiNaC::function>(part) ||
        GiNaC::ex_to<GiNaC::function>(part).get_name() != "atan2")
      return false;
    // Of a fixed y other than 0, or a fixed x > 0, the half line y = 0, x < 0 is not met.
    const bool is_beside = GiNaC::is_a<GiNaC::numeric>(part.op(0)) && !part.op(0).is_zero();
    return !is_beside && !part.op(1).info(GiNaC::info_flags::positive);
  });
}

/// Are `residuals` zero on the level, and is the level itself invariant?
void decide_on_invariant_level(Prover& prover, Proof& proof, const std::vector<Residual>& residuals,
                               const NamedExpression& f, const std::vector<NamedExpression>& on) {
  if (on.empty()) {
    prover.decide(proof, residuals, {});
    prover.say_where_motion_is_unique(proof, f);
    return;
  }
  Proof invariance;
  prover.decide_invariance(invariance, on);
  if (invariance.verdict == Verdict::proved) {
    const Level level = prover.level(on);
    prover.decide(proof, residuals, level);
    if (proof.verdict == Verdict::proved &&
        !prover.is_smooth_on(proof, level, {f}, Prover::Smooth::along_motion))
      return;
    for (const std::string& condition : invariance.where) {
      if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
        proof.where.push_back(condition);
    }
    return;
  }
  proof.verdict = invariance.verdict;
  proof.reason = "the level is not shown to be invariant: " + invariance.reason;
  if (invariance.verdict == Verdict::refuted)
    proof.reason = "the level is not invariant: " + invariance.reason;
  proof.residual = invariance.residual;
  proof.witness = invariance.witness;
  proof.nonzero = invariance.nonzero;
}

/// A level may fail to be invariant outside of the constraints only.
void decide_motions(Prover& prover, Proof& proof, const std::vector<NamedExpression>& on,
                    const DecideOnLevel& decide) {
  decide_within_constraints(prover, proof, on, decide, [&](const Proof& open) {
    return open.verdict == Verdict::refuted || is_open_on_constraints(prover, open);
  });
}

}  // namespace

Claim integral_claim(const NamedExpression& f, const std::vector<NamedExpression>& on) {
  return {ClaimKind::integral,
          f.name,
          false,
          [f, on](Prover& prover, Proof& proof) {
            decide_motions(prover, proof, on, [&](Proof& own, const auto& level) {
              decide_on_invariant_level(prover, own, {rate_of(prover, f)}, f, level);
            });
            if (proof.verdict != Verdict::proved) return;
            prover.say_where_it_jumps(proof, prover.convert(f.value), false);
            if (has_angle(f.value))
              proof.evidence +=
                  (proof.evidence.empty() ? "" : "; ") +
                  std::string("constant between the jumps that atan2 makes at its cut");
          },
          names_of(on),
          values_of(on, f),
          false,
          Subject::motion,
          LevelClaim{f, on}};
}

Claim conditional_claim(const NamedExpression& f, const std::vector<NamedExpression>& on) {
  Claim claim = integral_claim(f, on);
  claim.kind = ClaimKind::conditional;
  return claim;
}

Claim invariant_relation_claim(const NamedExpression& f, const std::vector<NamedExpression>& on) {
  return {ClaimKind::invariant_relation,
          f.name,
          false,
          [f, on](Prover& prover, Proof& proof) {
            // The common zero level of f and `on` has to be carried into itself.
            decide_motions(prover, proof, on, [&](Proof& own, const auto& level) {
              std::vector<NamedExpression> all = level;
              all.push_back(f);
              prover.decide_invariance(own, all);
            });
          },
          names_of(on),
          values_of(on, f),
          false,
          Subject::motion,
          LevelClaim{f, on}};
}

std::vector<Claim> integral_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const NamedExpression& f : model.integrals) claims.push_back(integral_claim(f, {}));
  return claims;
}

std::vector<Claim> conditional_claims(const Model& model) {
  std::vector<Claim> claims;
  for (const LevelClaim& claim : model.conditionals)
    claims.push_back(conditional_claim(claim.expression, claim.on));
  return claims;
}

std::vector<Claim> invariant_relation_claims(const Model& model) {
  std::vector<Claim> claims;
  // What restricts the scenes has to restrict their motions.
  if (!model.constraints.empty()) {
    const std::vector<NamedExpression> others(model.constraints.begin(),
                                              model.constraints.end() - 1);
    claims.push_back(invariant_relation_claim(model.constraints.back(), others));
    claims.back().name = "constraints";
  }
  for (const LevelClaim& claim : model.invariant_relations) {
    claims.push_back(invariant_relation_claim(claim.expression, claim.on));
  }
  return claims;
}

namespace {

/// The names of the theorems about a function.
struct TheoremNames {
  std::string function;  ///< what the file calls it
  const char* theorem;
};

/// df/dt and the rates of the functions of its level lie in the ideal of the level; that of an
/// invariant relation contains the function itself.
void certify_rates(CertificateWriter& writer, const Statement& statement,
                   const CertificateWriter::Parts& p, const TheoremNames& names, bool relation) {
  std::vector<Polynomial> zero = p.level;
  if (relation) zero.push_back(p.function);
  const CoqFunction& hamiltonian = writer.hamiltonian();
  const auto rate = [&](const Polynomial& f) {
    return CertificateWriter::cofactors(writer.bracket(f, hamiltonian.value), zero);
  };
  const std::vector<Polynomial> own = rate(p.function);
  std::vector<std::vector<Polynomial>> others;
  for (const Polynomial& g : p.level) others.push_back(rate(g));

  CoqFile& file = writer.file();
  file.begin_part(statement.title());
  const CoqFunction f = file.define(names.function, p.function);
  std::vector<CoqFunction> level = writer.define_level(names.function, p.level);
  if (relation) level.push_back(f);
  file.state_bracket(names.function + names.theorem, f, hamiltonian, level, own);
  for (std::size_t k = 0; k < others.size(); ++k)
    file.state_bracket(level[k].name + "_is_invariant", level[k], hamiltonian, level, others[k]);
}

const char* conserved(const CertificateWriter::Parts& p) {
  return p.level.empty() ? "_is_conserved" : "_is_conserved_on_its_level";
}

}  // namespace

void certify_integral(CertificateWriter& writer, const Statement& statement) {
  const CertificateWriter::Parts p = writer.parts(statement);
  certify_rates(writer, statement, p, {"integral_" + coq_name(p.name), conserved(p)}, false);
}

void certify_conditional(CertificateWriter& writer, const Statement& statement) {
  const CertificateWriter::Parts p = writer.parts(statement);
  certify_rates(writer, statement, p,
                {fmt::format("conditional_{}", statement.number), conserved(p)}, false);
}

void certify_invariant_relation(CertificateWriter& writer, const Statement& statement) {
  const CertificateWriter::Parts p = writer.parts(statement);
  certify_rates(writer, statement, p,
                {fmt::format("relation_{}", statement.number), "_is_invariant"}, true);
}

}  // namespace casimir
