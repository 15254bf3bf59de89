// What a case claims of its map x -> x'. All are identities of functions of x, in the ring of the
// prover, with x' put in; a statement is about the points at which the map and its functions have
// real values, so that everything that is put together is among the expressions of the claim.
#include "symbolic/discrete/map_claims.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/map_measure_claim.hpp"
#include "symbolic/discrete/values_between_steps.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/density.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir::discrete {
namespace {

using GiNaC::ex;
using Functions = std::vector<NamedExpression>;

/// Decides what is said of one map of a composition, in a ring of its own: what another step takes
/// the root of is positive at another point.
Proof decided_alone(const Model& model, const Claim& claim) {
  Proof proof;
  Prover prover(model, claim.expressions, claim.subject);
  prover.take_as_inhabited(has_arbitrary_functions(model));
  prover.begin_claim(claim.expressions, claim.subject);
  claim.decide(prover, proof);
  return proof;
}

/// Decides a claim of the composition as of one map.
void decide_whole(const MapModel& map, const Claim& whole, Proof& proof) {
  Prover alone(map.base, whole.expressions, whole.subject);
  alone.take_as_inhabited(has_arbitrary_functions(map.base));
  alone.begin_claim(whole.expressions, whole.subject);
  proof.where.clear();
  whole.decide(alone, proof);
}

/// Where the composition and all that is said of it have values: of the steps alone each says only
/// where it has one itself, in variables that stand for another point.
void say_where_composition_is(const Model& model, const Claim& whole, Proof& proof) {
  constexpr double kFewTerms = 1000;  // of more the normal form takes longer than the proof
  double terms = 0;
  for (const ex& part : whole.expressions) terms += most_terms(part);
  if (terms > kFewTerms) {
    proof.nonzero.emplace_back("the denominators of the steps");
    return;
  }
  Prover alone(model, whole.expressions, whole.subject);
  alone.take_as_inhabited(has_arbitrary_functions(model));
  alone.begin_claim(whole.expressions, whole.subject);
  Proof nothing;
  alone.decide(nothing, {}, {});
  proof.nonzero = nothing.nonzero;
  proof.positive = nothing.positive;
  proof.not_zero = nothing.not_zero;
  add_conditions(proof, nothing.where);
}

/// Something to be said of a claim beside its proof; empty for nothing.
using Note = std::function<std::string(Prover&)>;

/// What every step keeps at all points, the composition keeps; of the first step the points are
/// those at which the assumptions hold, those of the others are where the ones before have led.
/// Where a step does not keep it, or not without a condition, or what is kept need not have a value
/// between the steps (`have_values_between_steps`), it is decided for the composition alone.
///
/// \param kept   the functions that the claim is about, beside the map
/// \param level  on which it is claimed
/// \param note   what there is to be said of it beside
Claim kept_by_steps(const MapModel& map, const std::vector<ex>& kept, const Functions& level,
                    const std::function<Claim(const MapModel&)>& claim_of, const Note& note) {
  std::vector<Claim> parts;
  for (const MapModel& step : map.steps) parts.push_back(claim_of(step));
  Claim claim = parts.front();
  for (const Claim& part : parts)
    claim.expressions.insert(claim.expressions.end(), part.expressions.begin(),
                             part.expressions.end());
  claim.decide = [&map, kept, level, parts, claim_of, note](Prover& prover, Proof& proof) {
    if (!have_values_between_steps(map, kept)) return decide_whole(map, claim_of(map), proof);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Proof own = decided_alone(map.steps[i].base, parts[i]);
      // One that is proved on the constraints alone says nothing of where others may lead.
      if (own.verdict == Verdict::proved && own.on.empty() && (i == 0 || own.where.empty())) {
        proof.where.insert(proof.where.end(), own.where.begin(), own.where.end());
        continue;
      }
      return decide_whole(map, claim_of(map), proof);
    }
    // One step may lead to where the next one has no value: then all this is about nothing.
    const std::vector<ex> steps = domain_of(map, {});
    const bool nowhere = level.empty() ? !prover.real_points().any(steps)
                                       : !prover.has_points_on(prover.level(level), steps);
    if (nowhere && !has_arbitrary_functions(map.base)) {
      proof.where.clear();
      proof.reason = fmt::format("no point{} was found at which all steps have real values",
                                 level.empty() ? "" : " of the level");
      return;
    }
    proof.verdict = Verdict::proved;
    say_where_composition_is(map.base, claim_of(map), proof);
    // What is said of a step, as that it reverses the orientation, need not hold of them all.
    proof.evidence = fmt::format("each of the {} steps keeps it", parts.size());
    if (const std::string text = note ? note(prover) : ""; !text.empty())
      proof.evidence += "; " + text;
  };
  return claim;
}

Claim by_steps(const MapModel& map, ClaimKind kind, const std::string& name,
               const std::vector<ex>& kept, const Functions& level,
               const std::function<Claim(const MapModel&)>& claim_of, const Note& note = {}) {
  return or_without_value(kind, name, [&] {
    return map.steps.empty() ? claim_of(map) : kept_by_steps(map, kept, level, claim_of, note);
  });
}

Claim whole_integral_claim(const MapModel& map, const NamedExpression& f, const Functions& on) {
  Claim claim{
      ClaimKind::integral, f.name, false, [&map, f, on](Prover& prover, Proof& proof) {
        std::vector<Residual> residuals = level_images(prover, map, on);
        residuals.push_back(difference(prover, fmt::format("the change of {} in a step", f.name),
                                       map.composed(f.value) - f.value));
        prover.decide(proof, residuals, prover.level(on));
      }};
  Functions all = on;
  all.push_back(f);
  claim.on = names_of(on);
  claim.expressions = domain_of(map, all);
  claim.subject = Subject::functions;
  return claim;
}

Claim whole_relation_claim(const MapModel& map, const NamedExpression& f, const Functions& on) {
  Functions all = on;
  all.push_back(f);
  Claim claim{ClaimKind::invariant_relation, f.name, false,
              [&map, all](Prover& prover, Proof& proof) {
                prover.decide(proof, level_images(prover, map, all), prover.level(all));
              }};
  claim.on = names_of(on);
  claim.expressions = domain_of(map, all);
  claim.subject = Subject::functions;
  return claim;
}

std::string poisson_name(const MapModel& map) {
  return map.sign > 0 ? "Poisson map" : "anti-Poisson map";
}

/// Of the structure matrix, with what they are defined by.
std::vector<ex> bracket_entries(const MapModel& map) {
  std::vector<ex> entries = map.base.bracket_domain;
  for (std::size_t i = 0; i < map.next.size(); ++i)
    for (std::size_t j = i + 1; j < map.next.size(); ++j)
      entries.push_back((*map.base.poisson)(i, j));
  return entries;
}

/// {x_i', x_j'} less what the bracket is at x', for i < j.
std::vector<Residual> poisson_defects(Prover& prover, const MapModel& map,
                                      const std::vector<ex>& images) {
  const auto& x = map.base.variables;
  std::vector<Residual> residuals;
  auto image = images.begin();
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j, ++image) {
      const ex& expected = *image;
      residuals.push_back(
          {fmt::format("{{{}', {}'}} less its image", x[i].get_name(), x[j].get_name()),
           prover.bracket(prover.convert(map.next[i]), prover.convert(map.next[j])) -
               prover.convert(expected),
           [&map, i, j, expected] {
             return map.base.poisson->bracket(map.next[i], map.next[j]) - expected;
           }});
    }
  }
  return residuals;
}

/// On constraints that are Casimir functions the bracket of two functions there needs nothing of
/// them nearby, so that the map has to be Poisson there alone, if it stays there.
void decide_poisson(Prover& prover, Proof& proof, const MapModel& map,
                    const std::vector<ex>& images) {
  const std::vector<Residual> defects = poisson_defects(prover, map, images);
  Functions on;
  decide_within_constraints(
      prover, proof, {},
      [&](Proof& own, const Functions& level) {
        on = level;
        std::vector<Residual> residuals = level_images(prover, map, on);
        residuals.insert(residuals.end(), defects.begin(), defects.end());
        prover.decide(own, residuals, prover.level(on));
      },
      [&](const Proof& open) {
        return is_open_on_constraints(prover, open) && constraints_are_casimirs(prover);
      });
  if (on.empty()) return prover.say_where_differentiable(proof, map.next);
  if (proof.verdict != Verdict::proved) return;
  Functions next;
  for (std::size_t i = 0; i < map.next.size(); ++i)
    next.push_back({map.base.variables[i].get_name() + "'", map.next[i], {}});
  prover.is_smooth_on(proof, prover.level(on), next);
}

Claim whole_poisson_claim(const MapModel& map) {
  const std::size_t n = map.next.size();
  std::vector<ex> images, parts;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      append(parts, map.composed_with_parts((*map.base.poisson)(i, j)));
      images.push_back(map.sign * map.composed((*map.base.poisson)(i, j)));
    }
  }
  Claim claim{
      ClaimKind::map, poisson_name(map), false,
      [&map, images](Prover& prover, Proof& proof) { decide_poisson(prover, proof, map, images); }};
  claim.expressions = domain_of(map, {});
  append(claim.expressions, parts);
  for (const ex& part : map.base.bracket_domain)
    append(claim.expressions, map.composed_with_parts(part));
  claim.subject = Subject::bracket;
  return claim;
}

}  // namespace

Claim integral_claim(const MapModel& map, const NamedExpression& f, const Functions& on) {
  return by_steps(map, ClaimKind::integral, f.name, values_of(on, f), on,
                  [f, on](const MapModel& own) { return whole_integral_claim(own, f, on); });
}

Claim invariant_relation_claim(const MapModel& map, const NamedExpression& f, const Functions& on) {
  Functions level = on;
  level.push_back(f);
  return by_steps(map, ClaimKind::invariant_relation, f.name, values_of(on, f), level,
                  [f, on](const MapModel& own) { return whole_relation_claim(own, f, on); });
}

Claim measure_claim(const MapModel& map, const NamedExpression& density) {
  return by_steps(
      map, ClaimKind::measure, density.name, values_of(Functions{density}), {},
      [density](const MapModel& own) { return measure_claim_of_one_map(own, density); },
      [density](Prover& prover) { return note_on_signs(prover, density.value); });
}

Claim casimir_claim(const MapModel& /*map*/, const NamedExpression& f, const Functions& on) {
  return casimir::casimir_claim(f, on);
}

/// Of an anti-Poisson map the steps need not all be anti-Poisson.
Claim poisson_claim(const MapModel& map) {
  const std::string name = poisson_name(map);
  if (map.sign > 0)
    return by_steps(map, ClaimKind::map, name, bracket_entries(map), {}, whole_poisson_claim);
  return or_without_value(ClaimKind::map, name, [&] { return whole_poisson_claim(map); });
}

namespace {

/// What the shift on tori asks for where several leaves have the same values of the Casimir
/// functions.
constexpr const char* kKeepsLeaf = "the map keeps the symplectic leaf";

bool has_variables(const GiNaC::ex& e, const Model& model) {
  return std::ranges::any_of(model.variables, [&](const GiNaC::symbol& x) { return e.has(x); });
}

/// Whether each common level of the Casimir functions is one leaf: the bracket is constant and they
/// are linear, so that it is a plane with one rank. Else it may have several parts: the map
/// c -> -c keeps c^2, c -> c + 2 Pi keeps sin(c), and {q, p} = q has the leaves q > 0 and q < 0.
bool levels_are_leaves(const Model& model) {
  const PoissonStructure& bracket = *model.poisson;
  for (std::size_t i = 0; i < bracket.dimension(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (has_variables(bracket(i, j).expand(), model)) return false;
  return std::ranges::all_of(model.casimirs, [&](const NamedExpression& f) {
    return std::ranges::all_of(model.variables, [&](const GiNaC::symbol& x) {
      return !has_variables(f.value.diff(x).expand(), model);
    });
  });
}

/// Hypothesis of the count on one leaf: the map keeps the leaves. A Poisson map may exchange them;
/// one that keeps as many independent Casimir functions as the rank falls short of the dimension
/// does not, where these tell the leaves apart: `levels_are_leaves`, or a condition. (That they are
/// integrals of the map is asked for elsewhere.)
std::string why_leaves_may_move(Prover& prover, const MapModel& map) {
  const auto leaf = bracket_rank(prover);
  if (!leaf || !leaf->exact || !leaf->uneven.empty()) return "the rank of the bracket is not known";
  const std::size_t needed = prover.dimension() - leaf->rank;
  if (needed == 0) return {};
  std::vector<Polynomial> casimirs;
  for (const NamedExpression& f : map.base.casimirs)
    if (is_casimir(prover, f)) casimirs.push_back(prover.convert(f.value));
  const auto rank = casimirs.empty() ? std::nullopt : gradient_rank(prover, casimirs);
  const std::size_t known = rank && rank->uneven.empty() ? rank->rank : 0;
  if (known >= needed) return {};
  return fmt::format(
      "the map is not shown to keep the leaves, which {} independent Casimir functions among "
      "'casimirs' would tell apart; {} known",
      needed, known);
}

/// Hypothesis of the shift on tori: the map is continuous there. A turn by one angle on one side of
/// a line and by another beyond takes circles to themselves, two points to one.
std::vector<std::string> where_map_jumps(Prover& prover, const MapModel& map) {
  std::vector<std::string> where;
  for (const ex& next : map.next) {
    for (const Polynomial& jump : prover.passed_jumps(prover.convert(next), true, true)) {
      // No orbit crosses what the map keeps.
      const ex function = prover.ring().expression(jump);
      if (prover.is_zero(prover.convert(map.composed(function)) - jump)) continue;
      std::string condition =
          fmt::format("on motions that do not cross {} = 0", prover.ring().text(jump));
      if (std::ranges::find(where, condition) == where.end()) where.push_back(std::move(condition));
    }
  }
  return where;
}

/// What a claim about the map and these functions is about; of a composition not what is said of
/// its steps, in variables that stand for another point.
std::vector<ex> expressions_of(const MapModel& map, const std::vector<Claim>& claims) {
  Functions kept = map.base.casimirs;
  kept.insert(kept.end(), map.base.integrals.begin(), map.base.integrals.end());
  std::vector<ex> result = domain_of(map, kept);
  if (map.steps.empty())
    for (const Claim& claim : claims) append(result, claim.expressions);
  return result;
}

}  // namespace

std::vector<Claim> liouville_claims(const MapModel& map) {
  std::vector<Claim> claims = casimir::liouville_claims(map.base);
  if (!map.base.poisson) return claims;  // undecided, where integrability is claimed all the same
  for (Claim& claim : claims) {
    std::vector<Claim> hypotheses{poisson_claim(map)};
    for (const auto* list : {&map.base.casimirs, &map.base.integrals})
      for (const NamedExpression& f : *list) hypotheses.push_back(integral_claim(map, f, {}));
    append(claim.expressions, expressions_of(map, hypotheses));
    claim.decide = [&map, hypotheses, count = claim.decide](Prover& prover, Proof& proof) {
      std::vector<std::string> conditions;
      for (const Claim& hypothesis : hypotheses) {
        Proof shown;
        hypothesis.decide(prover, shown);
        conditions.insert(conditions.end(), shown.where.begin(), shown.where.end());
        if (shown.verdict == Verdict::proved && shown.on.empty() && map.sign > 0) continue;
        proof.reason = hypothesis.kind == ClaimKind::map
                           ? shown.on.empty()
                                 ? "the map is not shown to be Poisson"
                                 : "the map is shown to be Poisson on the constraints alone"
                           : fmt::format("{} is not shown to be an integral", hypothesis.name);
        return;
      }
      proof.reason = why_leaves_may_move(prover, map);
      if (!proof.reason.empty()) return;
      count(prover, proof);
      if (proof.verdict != Verdict::proved) return;
      if (!levels_are_leaves(map.base)) conditions.emplace_back(kKeepsLeaf);
      const std::vector<std::string> jumps = where_map_jumps(prover, map);
      conditions.insert(conditions.end(), jumps.begin(), jumps.end());
      add_conditions(proof, conditions);
    };
  }
  return claims;
}

}  // namespace casimir::discrete
