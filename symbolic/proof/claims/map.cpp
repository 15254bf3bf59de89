// Poisson and anti-Poisson maps y = phi(x): {phi_i, phi_j} = sign * {y_i, y_j} at y = phi(x).
#include <cln/rational.h>
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"

namespace casimir {
namespace {

/// Whether the difference is a number that does not obey the condition.
bool is_outside(Prover& prover, const Assumption& condition) {
  const Polynomial value = prover.ring().reduced(prover.convert(condition.difference));
  if (!value.is_constant() || value.is_zero()) return false;
  const cln::cl_RA number = value.term_list()[0].first;
  return !holds(condition.comparison, cln::plusp(number) ? 1 : -1);
}

void add_unless_said(std::vector<std::string>& conditions, std::string condition) {
  if (std::find(conditions.begin(), conditions.end(), condition) == conditions.end())
    conditions.push_back(std::move(condition));
}

/// Whether the map leads into the target's domain at all: a number obeys a condition or does not.
/// Where it leads beside the zeros of a function only, the verdict says so.
bool leads_into_domain(Prover& prover, Proof& proof, const PoissonMap& map) {
  for (const Assumption& condition : map.leads_to) {
    const Polynomial difference = prover.ring().numerator(prover.convert(condition.difference));
    const bool is_zero = difference.is_zero();
    if (is_zero ? !holds(condition.comparison, 0) : is_outside(prover, condition)) {
      proof.verdict = Verdict::undecided;
      proof.evidence.clear();
      proof.where.clear();
      proof.reason =
          fmt::format("nothing that the map leads to is in the domain of 'to': {} holds nowhere",
                      condition.text);
      return false;
    }
    if (condition.comparison == Comparison::unequal && !prover.ring().is_nowhere_zero(difference))
      add_unless_said(proof.where, prover.ring().text(difference) + " != 0");
  }
  return true;
}

/// What the target's domain asks of the image: real logarithms and roots stand for it.
void say_where_it_leads(Prover& prover, Proof& proof, const PoissonMap& map) {
  for (const GiNaC::ex& part : map.domain) {
    const bool logarithm = GiNaC::is_a<GiNaC::function>(part) &&
                           GiNaC::ex_to<GiNaC::function>(part).get_name() == "log";
    const bool root = GiNaC::is_a<GiNaC::power>(part) && part.op(1).is_equal(GiNaC::ex(1) / 2);
    if (!logarithm && !root) continue;
    const Polynomial& inside = prover.convert(part.op(0));
    if (prover.ring().is_assumed_positive(inside)) continue;
    add_unless_said(proof.where, prover.ring().text(inside) + (logarithm ? " > 0" : " >= 0"));
  }
}

GiNaC::exmap image_point(const PoissonMap& map) {
  GiNaC::exmap point;
  for (std::size_t i = 0; i < map.expressions.size(); ++i)
    point[map.target.coordinates()[i]] = map.expressions[i];
  return point;
}

std::vector<GiNaC::ex> composed(const std::vector<GiNaC::ex>& functions, const GiNaC::exmap& at,
                                const Limits& limits) {
  std::vector<GiNaC::ex> result;
  for (const GiNaC::ex& f : functions) result.push_back(substituted(f, at, limits));
  return result;
}

/// What is said of the image, at phi(x): it has to vanish on this case's constraints.
std::vector<std::pair<std::string, GiNaC::ex>> image_defects(const PoissonMap& map,
                                                             const Limits& limits) {
  const GiNaC::exmap image = image_point(map);
  std::vector<std::pair<std::string, GiNaC::ex>> defects;
  for (const NamedExpression& f : map.image)
    defects.emplace_back(fmt::format("{} on the image", f.name),
                         substituted(f.value, image, limits));
  return defects;
}

std::vector<Residual> residuals_of(Prover& prover,
                                   const std::vector<std::pair<std::string, GiNaC::ex>>& defects) {
  std::vector<Residual> residuals;
  for (const auto& [label, defect] : defects)
    residuals.push_back({label, prover.convert(defect), [value = defect] { return value; }});
  return residuals;
}

/// Whether the map leads where it is said to lead. Where it has an inverse everywhere, the claim of
/// that says so.
bool leads_to_its_image(Prover& prover, Proof& proof, const PoissonMap& map) {
  const bool said = std::any_of(map.inverses.begin(), map.inverses.end(),
                                [](const MapInverse& own) { return own.domain.empty(); });
  if (map.image.empty() || said) return true;
  std::vector<NamedExpression> level = map.on;
  for (const NamedExpression& f : prover.model().constraints) level.push_back(f);
  Proof own = proof;
  prover.decide(own, residuals_of(prover, image_defects(map, prover.model().limits)),
                prover.level(level));
  if (own.verdict == Verdict::proved) {
    proof.where = own.where;
    return true;
  }
  proof = std::move(own);
  return false;
}

void decide_map(Prover& prover, Proof& proof, const PoissonMap& map) {
  const std::vector<GiNaC::ex> target = map.composed_brackets();
  const auto& y = map.target.coordinates();
  std::vector<Residual> residuals;
  std::size_t index = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    for (std::size_t j = i + 1; j < y.size(); ++j, ++index) {
      const GiNaC::ex expected = map.sign * target[index];
      residuals.push_back(
          {fmt::format("{{{0}, {1}}} less its image", y[i].get_name(), y[j].get_name()),
           prover.bracket(prover.convert(map.expressions[i]), prover.convert(map.expressions[j])) -
               prover.convert(expected),
           [&prover, &map, i, j, expected] {
             return prover.model().poisson->bracket(map.expressions[i], map.expressions[j]) -
                    expected;
           }});
    }
  }
  std::vector<NamedExpression> on;
  decide_within_constraints(
      prover, proof, map.on,
      [&](Proof& own, const std::vector<NamedExpression>& level) {
        on = level;
        prover.decide(own, residuals, prover.level(on));
      },
      [&](const Proof& open) {
        return is_open_on_constraints(prover, open) && constraints_are_casimirs(prover);
      });
  if (proof.verdict != Verdict::proved || !leads_to_its_image(prover, proof, map) ||
      !leads_into_domain(prover, proof, map))
    return;
  say_where_it_leads(prover, proof, map);
  if (on.empty()) return prover.say_where_differentiable(proof, map.expressions);
  std::vector<NamedExpression> functions;
  for (std::size_t i = 0; i < y.size(); ++i)
    functions.push_back({y[i].get_name(), map.expressions[i], {}});
  prover.is_smooth_on(proof, prover.level(on), functions);
}

GiNaC::exmap lift_of(const Model& model, const PoissonMap& map, const MapInverse& inverse) {
  const std::vector<GiNaC::ex> lifted =
      composed(inverse.expressions, image_point(map), model.limits);
  GiNaC::exmap lift;
  for (std::size_t i = 0; i < lifted.size(); ++i) lift[model.variables[i]] = lifted[i];
  return lift;
}

/// The functions that have to vanish on this case's constraints for `inverse` to be what it is said
/// to be: phi(inverse(phi(x))) - phi(x), so that it is a right inverse wherever phi leads, the
/// constraints at inverse(phi(x)), and what is claimed of the image at phi(x).
std::vector<std::pair<std::string, GiNaC::ex>> inverse_defects(const Model& model,
                                                               const PoissonMap& map,
                                                               const MapInverse& inverse) {
  const GiNaC::exmap lift = lift_of(model, map, inverse);
  std::vector<std::pair<std::string, GiNaC::ex>> defects;
  const std::vector<GiNaC::ex> again = composed(map.expressions, lift, model.limits);
  for (std::size_t i = 0; i < again.size(); ++i) {
    defects.emplace_back(
        fmt::format("{} of the inverse less itself", map.target.coordinates()[i].get_name()),
        again[i] - map.expressions[i]);
  }
  for (const NamedExpression& constraint : model.constraints)
    defects.emplace_back(fmt::format("{} at the inverse", constraint.name),
                         substituted(constraint.value, lift, model.limits));
  for (auto& defect : image_defects(map, model.limits)) defects.push_back(std::move(defect));
  return defects;
}

/// The conditions of an inverse's domain at phi(x).
std::vector<Assumption> conditions_of(const Model& model, const PoissonMap& map,
                                      const MapInverse& inverse) {
  const GiNaC::exmap image = image_point(map);
  std::vector<Assumption> conditions = inverse.domain;
  for (Assumption& condition : conditions) {
    condition.difference = substituted(condition.difference, image, model.limits);
    condition.text = fmt::format("{} at the image", condition.text);
  }
  return conditions;
}

/// A condition of this case's domain, and what it is about at inverse(phi(x)).
struct ConditionAtInverse {
  Assumption condition;
  GiNaC::ex there;
};

std::vector<ConditionAtInverse> domain_at_inverse(const Model& model, const PoissonMap& map,
                                                  const MapInverse& inverse) {
  const GiNaC::exmap lift = lift_of(model, map, inverse);
  std::vector<ConditionAtInverse> conditions;
  for (const Assumption& condition : model.assumptions) {
    const GiNaC::ex there = substituted(condition.difference, lift, model.limits);
    if (!there.is_equal(condition.difference)) conditions.push_back({condition, there});
  }
  return conditions;
}

/// Whether the assumptions imply it, as far as the signs of factors tell.
bool is_implied(Prover& prover, const Assumption& condition) {
  const FunctionRing& ring = prover.ring();
  const Polynomial value = ring.reduced(prover.convert(condition.difference));
  if (value.is_constant())
    return holds(condition.comparison,
                 value.is_zero() ? 0 : (cln::plusp(value.term_list()[0].first) ? 1 : -1));
  switch (condition.comparison) {
    case Comparison::greater:
    case Comparison::at_least:
      return ring.is_assumed_positive(value);
    case Comparison::less:
    case Comparison::at_most:
      return ring.is_assumed_positive(-value);
    case Comparison::unequal:
      return ring.is_nowhere_zero(value);
    case Comparison::equal:
      break;
  }
  return false;
}

/// Whether the constraints alone imply it, to which the inverse leads.
bool follows_from_constraints(const Model& model, const Assumption& condition) {
  return std::ranges::any_of(model.constraints, [&](const NamedExpression& c) {
    for (const int sign : {1, -1}) {
      const GiNaC::ex rest = (condition.difference + sign * c.value).expand();
      if (GiNaC::is_a<GiNaC::numeric>(rest) && GiNaC::ex_to<GiNaC::numeric>(rest).is_real())
        return holds(condition.comparison, GiNaC::ex_to<GiNaC::numeric>(rest).csgn());
    }
    return false;
  });
}

/// Whether a condition of the case holds at inverse(phi(x)): what it is about is what it was at x,
/// or has the sign.
bool holds_at_inverse(const Model& model, Prover& prover, const ConditionAtInverse& at) {
  if (prover.is_zero(prover.convert(at.there) - prover.convert(at.condition.difference)))
    return true;
  Assumption there = at.condition;
  there.difference = at.there;
  return is_implied(prover, there) || follows_from_constraints(model, at.condition);
}

/// An inverse leads back into the domain of the case: -sqrt(u) is none of u = q^2 for q > 0.
///
/// \param prover  may assume more than the case
void leads_back_into_domain(const Model& model, Prover& prover, Proof& proof, const PoissonMap& map,
                            const MapInverse& inverse) {
  if (proof.verdict != Verdict::proved) return;
  for (const ConditionAtInverse& at : domain_at_inverse(model, map, inverse)) {
    if (holds_at_inverse(model, prover, at)) continue;
    proof.verdict = Verdict::undecided;
    proof.evidence.clear();
    proof.where.clear();
    proof.reason = fmt::format("that it leads into the domain of this case, {}, is not shown",
                               at.condition.text);
    return;
  }
}

/// What the claim that it is an inverse is about: the inverse at phi(x), and phi, the constraints
/// and the domain of this case at inverse(phi(x)). What is said of the image is in `map.domain`.
std::vector<GiNaC::ex> expressions_of_inverse(const Model& model, const PoissonMap& map,
                                              const MapInverse& inverse) {
  std::vector<GiNaC::ex> expressions;
  const auto need = [&](const GiNaC::ex& f, const GiNaC::exmap& at) {
    for (const GiNaC::ex& part : substituted_with_parts(f, at, model.limits))
      expressions.push_back(part);
  };
  const GiNaC::exmap image = image_point(map);
  for (const auto* list : {&inverse.expressions, &inverse.defined_by})
    for (const GiNaC::ex& f : *list) need(f, image);
  for (const Assumption& condition : inverse.domain) need(condition.difference, image);
  const GiNaC::exmap lift = lift_of(model, map, inverse);
  for (const GiNaC::ex& f : map.expressions) need(f, lift);
  for (const GiNaC::ex& f : values_of(model.constraints)) need(f, lift);
  for (const Assumption& condition : model.assumptions) need(condition.difference, lift);
  for (const ConditionAtInverse& at : domain_at_inverse(model, map, inverse))
    expressions.push_back(at.condition.difference);
  for (const auto& [label, defect] : inverse_defects(model, map, inverse))
    expressions.push_back(defect);
  expressions.insert(expressions.end(), map.domain.begin(), map.domain.end());
  return expressions;
}

/// Of an inverse with a domain nothing is claimed but at points that the map leads into that: its
/// conditions are assumptions, of this claim alone.
void decide_inverse(Prover& prover, Proof& proof, std::size_t index, std::size_t branch) {
  const Model& model = prover.model();
  const PoissonMap& map = model.maps[index];
  const MapInverse& inverse = map.inverses[branch];
  const auto decide = [&](Prover& own) {
    own.decide(proof, residuals_of(own, inverse_defects(model, map, inverse)),
               own.level(model.constraints));
    leads_back_into_domain(model, own, proof, map, inverse);
  };
  if (inverse.domain.empty()) return decide(prover);
  Model inside = model;
  for (Assumption& condition : conditions_of(model, map, inverse))
    inside.assumptions.push_back(std::move(condition));
  const std::vector<GiNaC::ex> expressions = expressions_of_inverse(model, map, inverse);
  Prover own(inside, expressions, Subject::functions);
  own.begin_claim(expressions, Subject::functions);
  decide(own);
}

Claim inverse_claim(const Model& model, std::size_t index, std::size_t branch) {
  const PoissonMap& map = model.maps[index];
  Claim claim{ClaimKind::map, map.name + ", right inverse", false, {}};
  claim.subject = Subject::functions;
  if (map.inverses.size() > 1) claim.name += fmt::format(" {}", branch + 1);
  claim.expressions = expressions_of_inverse(model, map, map.inverses[branch]);
  claim.on = names_of(model.constraints);
  claim.decide = [index, branch](Prover& prover, Proof& proof) {
    decide_inverse(prover, proof, index, branch);
  };
  return claim;
}

std::vector<GiNaC::ex> expressions_of(const PoissonMap& map, const Limits& limits) {
  std::vector<GiNaC::ex> expressions = values_of(map.on);
  expressions.insert(expressions.end(), map.expressions.begin(), map.expressions.end());
  for (const GiNaC::ex& bracket : map.composed_brackets()) expressions.push_back(bracket);
  // What GiNaC simplified away: sqrt(q)^2 is q only where q >= 0.
  expressions.insert(expressions.end(), map.domain.begin(), map.domain.end());
  for (const Assumption& condition : map.leads_to) expressions.push_back(condition.difference);
  for (const auto& [label, defect] : image_defects(map, limits)) expressions.push_back(defect);
  return expressions;
}

}  // namespace

std::vector<Claim> map_claims(const Model& model) {
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < model.maps.size(); ++i) {
    claims.push_back(
        {ClaimKind::map, model.maps[i].name, false,
         [i](Prover& prover, Proof& proof) { decide_map(prover, proof, prover.model().maps[i]); },
         names_of(model.maps[i].on), expressions_of(model.maps[i], model.limits), false,
         Subject::bracket});
    for (std::size_t branch = 0; branch < model.maps[i].inverses.size(); ++branch)
      claims.push_back(inverse_claim(model, i, branch));
  }
  return claims;
}

}  // namespace casimir
