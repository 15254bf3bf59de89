// A candidate judged on all of it: is it a Casimir function, does it follow from the known
// integrals and how, and if it is no integral, is it one on a level that the case knows?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/dependence.hpp"
#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/special_parameters.hpp"

namespace casimir {
namespace {

using Functions = std::vector<NamedExpression>;

Proof finding_of(Prover& prover, const Claim& claim) {
  Proof proof;
  proof.kind = claim.kind;
  proof.name = claim.name;
  proof.on = claim.on;
  claim.decide(prover, proof);
  return proof;
}

Functions known_integrals(const Model& model) {
  Functions known = model.casimirs;
  if (model.hamiltonian && !model.time)
    known.push_back({hamiltonian_name(model), *model.hamiltonian, {}});
  known.insert(known.end(), model.integrals.begin(), model.integrals.end());
  return known;
}

/// Does the candidate follow from the known Casimirs and integrals?
Proof independence_finding(Prover& prover, const NamedExpression& f) {
  const Functions known = known_integrals(prover.model());
  Proof proof;
  proof.kind = ClaimKind::independence;
  proof.name = f.name;
  const auto rank_of = [&](const Functions& functions) -> std::size_t {
    std::vector<Polynomial> values;
    for (const NamedExpression& g : functions) values.push_back(prover.convert(g.value));
    const auto found = values.empty() ? std::nullopt : gradient_rank(prover, values);
    return found ? found->rank : 0;
  };
  Functions all{f};
  all.insert(all.end(), known.begin(), known.end());
  const std::string names = fmt::format("{}", fmt::join(names_of(known), ", "));
  if (prover.gradient(prover.convert(f.value)) ==
      std::vector<Polynomial>(prover.dimension(), Polynomial(prover.ring().ring()))) {
    proof.verdict = Verdict::refuted;
    proof.reason = "it is a constant";
    return proof;
  }
  const std::size_t before = rank_of(known);
  if (before == known.size() && rank_of(all) > before) {
    proof.verdict = Verdict::proved;
    proof.evidence = known.empty() ? "it is not constant" : "it is independent of " + names;
    PolynomialRows slopes;
    for (const NamedExpression& g : all) slopes.push_back(prover.gradient(prover.convert(g.value)));
    proof.where = needed_parameters(prover, slopes, all.size());
    if (!proof.where.empty())
      proof.evidence += fmt::format(" where {}", fmt::join(proof.where, ", "));
    return proof;
  }
  const bool more = rank_of(all) > before;
  const auto follows = [&](const Functions& from, bool independent) {
    Functions functions{f};
    functions.insert(functions.end(), from.begin(), from.end());
    const auto relation = polynomial_relation(prover, functions, independent);
    if (!relation) return false;
    proof.verdict = Verdict::refuted;
    proof.reason =
        fmt::format("it follows from {}: {}", fmt::join(names_of(from), ", "), *relation);
    return true;
  };
  if (!more && follows(known, before == known.size())) return proof;
  if (!more && before < known.size()) {
    // A relation between the known ones alone hides one with the candidate.
    Functions independent;
    for (const NamedExpression& g : known) {
      independent.push_back(g);
      if (rank_of(independent) < independent.size()) independent.pop_back();
    }
    if (follows(independent, true)) return proof;
  }
  proof.reason = more ? "it is independent of the independent ones among " + names
                      : "its gradient depends on those of " + names +
                            " at the points tried; no polynomial relation of low degree was found";
  return proof;
}

/// The levels that the case itself speaks of.
std::vector<Functions> known_levels(const Model& model) {
  std::vector<Functions> levels;
  const auto add = [&](Functions level) {
    const bool known = std::any_of(levels.begin(), levels.end(), [&](const Functions& other) {
      return std::equal(other.begin(), other.end(), level.begin(), level.end(),
                        [](const NamedExpression& f, const NamedExpression& g) {
                          return (f.value - g.value).expand().is_zero();
                        });
    });
    if (!known && !level.empty()) levels.push_back(std::move(level));
  };
  add(model.constraints);
  for (const LevelClaim& claim : model.conditionals) add(claim.on);
  for (const NamedExpression& casimir : model.casimirs) add({casimir});
  for (const LevelClaim& claim : model.invariant_relations) {
    Functions level = claim.on;
    level.push_back(claim.expression);
    add(std::move(level));
  }
  return levels;
}

void judge(Prover& prover, Proof& note, const NamedExpression& f) {
  const Proof integral = finding_of(prover, integral_claim(f, {}));
  note.verdict = Verdict::proved;
  note.findings.push_back(integral);
  if (integral.verdict == Verdict::proved) {
    if (prover.model().poisson) note.findings.push_back(finding_of(prover, casimir_claim(f, {})));
    note.findings.push_back(independence_finding(prover, f));
    return;
  }
  prover.disregard_constraints();
  for (const Functions& level : known_levels(prover.model())) {
    // Of x^2 + y^2 + z^2 the zero level is one point, where too much is an integral.
    const Level points = prover.level(level);
    if (points.functions.size() > level.size()) continue;
    Proof vanishing;
    const Polynomial value = prover.convert(f.value);
    prover.decide(vanishing, {{f.name, value, [&f] { return f.value; }}}, points);
    if (vanishing.verdict == Verdict::proved) continue;
    const Proof on_level = finding_of(prover, conditional_claim(f, level));
    if (on_level.verdict == Verdict::proved) note.findings.push_back(on_level);
  }
  const Proof relation = finding_of(prover, invariant_relation_claim(f, {}));
  if (relation.verdict == Verdict::proved) note.findings.push_back(relation);
}

}  // namespace

Claim judgement_note(const Model& model, const NamedExpression& f) {
  Claim note{ClaimKind::judgement, f.name, false,
             [f](Prover& prover, Proof& proof) { judge(prover, proof, f); }};
  note.note = true;
  note.expressions = values_of(known_integrals(model), f);
  for (const Functions& level : known_levels(model)) {
    for (const GiNaC::ex& value : values_of(level)) note.expressions.push_back(value);
  }
  return note;
}

}  // namespace casimir
