// A candidate judged on all of it: is it a Casimir function, does it follow from the known
// integrals and how, and if it is no integral, is it one on a level that the case knows?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/constraint_set.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/dependence.hpp"
#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/special_parameters.hpp"

namespace casimir {
namespace {

using Functions = std::vector<NamedExpression>;

/// Decides each finding where its own functions have values: that another integral of the case, or
/// a level of another claim, has some only for p > 0 says nothing of the candidate.
class Judge {
 public:
  Judge(Prover& prover, NamedExpression f)
      : prover_(prover), f_(std::move(f)), shared_(prover.ring().is_polynomial()) {}

  void judge(Proof& note);

 private:
  /// What `decide` finds, by a prover that knows nothing beside these expressions.
  template <class Decide>
  void with_own_prover(const std::vector<GiNaC::ex>& expressions, Subject subject,
                       const Decide& decide) {
    if (shared_) return decide(prover_);
    Prover own(prover_.model(), expressions, subject);
    own.begin_claim(expressions, subject);
    decide(own);
  }
  Proof finding_of(const Claim& claim);
  Proof independence();
  void find_on_levels(Proof& note);

  Prover& prover_;
  const NamedExpression f_;
  const bool shared_;  ///< all has values everywhere
};

Proof Judge::finding_of(const Claim& claim) {
  Proof proof;
  proof.kind = claim.kind;
  proof.name = claim.name;
  proof.on = claim.on;
  with_own_prover(claim.expressions, claim.subject,
                  [&](Prover& prover) { claim.decide(prover, proof); });
  return proof;
}

Functions known_integrals(const Model& model) {
  Functions known = model.casimirs;
  if (model.hamiltonian && !model.time) known.push_back(hamiltonian_of(model));
  known.insert(known.end(), model.integrals.begin(), model.integrals.end());
  return known;
}

/// Where the functions of a relation have values, beyond the assumptions: a phrase, or nothing.
std::string where_all_have_values(const Prover& prover) {
  std::vector<std::string> conditions;
  const functions::Implied implied = prover.ring().implied_by_values();
  for (const auto& [p, strict] : implied.positive)
    conditions.push_back(prover.ring().text(p) + (strict ? " > 0" : " >= 0"));
  for (const Polynomial& p : implied.nonzero) conditions.push_back(prover.ring().text(p) + " != 0");
  return conditions.empty() ? "" : fmt::format(", where {}", fmt::join(conditions, ", "));
}

/// Whether the gradient of a function is zero wherever it has one.
bool has_no_gradient(Prover& prover, const NamedExpression& f) {
  return prover.gradient(prover.convert(f.value)) ==
         std::vector<Polynomial>(prover.dimension(), Polynomial(prover.ring().ring()));
}

/// Whether it is a number, or a function of parameters. A gradient of zero says less: that of
/// atan2(p, q) + atan2(q, p) is, and there are two values.
bool is_constant(const Prover& prover, const Polynomial& value) {
  const Model& model = prover.model();
  const GiNaC::ex shown = prover.ring().expression(value);
  return std::ranges::none_of(model.variables, [&](const auto& x) { return shown.has(x); }) &&
         !(model.time && shown.has(*model.time));
}

/// Does the candidate follow from the known Casimirs and integrals?
void decide_independence(Prover& prover, const NamedExpression& f, Proof& proof) {
  const Functions known = known_integrals(prover.model());
  if (!prover.model().constraints.empty() && ConstraintSet(prover).makes_constant(f)) {
    proof.verdict = Verdict::refuted;
    proof.reason = "it is a constant on the constraints";
    return;
  }
  std::string where, uneven;  // of the last rank
  const auto rank_of = [&](const Functions& functions) -> std::size_t {
    std::vector<Polynomial> values;
    for (const NamedExpression& g : functions) values.push_back(prover.convert(g.value));
    const auto found = values.empty() ? std::nullopt : gradient_rank(prover, values);
    where = found ? found->where : "";
    uneven = found ? found->uneven : "";
    return found ? found->rank : 0;
  };
  Functions all{f};
  all.insert(all.end(), known.begin(), known.end());
  const std::string names = fmt::format("{}", fmt::join(names_of(known), ", "));
  const std::size_t before = rank_of(known);
  if (before == known.size() && rank_of(all) > before) {
    if (!uneven.empty()) {
      proof.reason = uneven;
      return;
    }
    proof.verdict = Verdict::proved;
    proof.evidence = known.empty() ? "it is not constant" : "it is independent of " + names;
    PolynomialRows slopes;
    for (const NamedExpression& g : all) slopes.push_back(prover.gradient(prover.convert(g.value)));
    proof.where = needed_parameters(prover, slopes, all.size());
    if (!where.empty()) proof.where.insert(proof.where.begin(), where);
    if (!proof.where.empty())
      proof.evidence += fmt::format(" where {}", fmt::join(proof.where, ", "));
    require_independence_on_constraints(prover, proof, all);
    return;
  }
  const bool more = rank_of(all) > before;
  const auto follows = [&](const Functions& from, bool independent) {
    Functions functions{f};
    functions.insert(functions.end(), from.begin(), from.end());
    const auto relation = polynomial_relation(prover, functions, independent);
    if (!relation) return false;
    proof.verdict = Verdict::refuted;
    proof.reason = fmt::format("it follows from {}: {}{}", fmt::join(names_of(from), ", "),
                               *relation, where_all_have_values(prover));
    return true;
  };
  if (!more && follows(known, before == known.size())) return;
  if (!more && before < known.size()) {
    // A relation between the known ones alone hides one with the candidate.
    Functions independent;
    for (const NamedExpression& g : known) {
      independent.push_back(g);
      if (rank_of(independent) < independent.size()) independent.pop_back();
    }
    if (follows(independent, true)) return;
  }
  proof.reason = more ? "it is independent of the independent ones among " + names
                      : "its gradient depends on those of " + names +
                            " at the points tried; no polynomial relation of low degree was found";
}

Proof Judge::independence() {
  Proof proof;
  proof.kind = ClaimKind::independence;
  proof.name = f_.name;
  with_own_prover(values_of({f_}), Subject::functions, [&](Prover& prover) {
    if (!has_no_gradient(prover, f_)) return;
    proof.verdict = Verdict::refuted;
    proof.reason = is_constant(prover, prover.convert(f_.value))
                       ? "it is a constant"
                       : "its gradient is zero: it is constant wherever it is smooth";
  });
  if (!proof.reason.empty()) return proof;
  const Model& model = prover_.model();
  with_own_prover(values_of(known_integrals(model), f_),
                  model.poisson ? Subject::bracket : Subject::motion,
                  [&](Prover& prover) { decide_independence(prover, f_, proof); });
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

void Judge::find_on_levels(Proof& note) {
  for (const Functions& level : known_levels(prover_.model())) {
    bool says_something = false;
    with_own_prover(values_of(level, f_), Subject::motion, [&](Prover& prover) {
      prover.disregard_constraints();
      // Of x^2 + y^2 + z^2 the zero level is one point, where too much is an integral.
      const Level points = prover.level(level);
      if (points.functions.size() > level.size()) return;
      Proof vanishing;
      prover.decide(vanishing, {{f_.name, prover.convert(f_.value), [&] { return f_.value; }}},
                    points);
      says_something = vanishing.verdict != Verdict::proved;
    });
    if (!says_something) continue;
    const Proof on_level = finding_of(conditional_claim(f_, level));
    if (on_level.verdict == Verdict::proved) note.findings.push_back(on_level);
  }
}

void Judge::judge(Proof& note) {
  const Proof integral = finding_of(integral_claim(f_, {}));
  note.verdict = Verdict::proved;
  note.findings.push_back(integral);
  if (integral.verdict == Verdict::proved) {
    if (prover_.model().poisson) note.findings.push_back(finding_of(casimir_claim(f_, {})));
    note.findings.push_back(independence());
    return;
  }
  prover_.disregard_constraints();
  find_on_levels(note);
  const Proof relation = finding_of(invariant_relation_claim(f_, {}));
  if (relation.verdict == Verdict::proved) note.findings.push_back(relation);
}

}  // namespace

Claim judgement_note(const Model& model, const NamedExpression& f) {
  Claim note{ClaimKind::judgement, f.name, false,
             [f](Prover& prover, Proof& proof) { Judge(prover, f).judge(proof); }};
  note.note = true;
  note.expressions = values_of(known_integrals(model), f);
  for (const Functions& level : known_levels(model)) {
    for (const GiNaC::ex& value : values_of(level)) note.expressions.push_back(value);
  }
  return note;
}

}  // namespace casimir
