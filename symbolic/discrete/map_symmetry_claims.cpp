// That a map has a symmetry or a reversal, or is conjugate to another map.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/map_claims.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/generic_rank.hpp"

namespace casimir::discrete {
namespace {

using GiNaC::ex;

/// (x, p) -> (S(x), S(p)).
GiNaC::exmap image_of(const MapModel& map, const MapSymmetry& symmetry) {
  GiNaC::exmap image;
  for (std::size_t i = 0; i < symmetry.variables.size(); ++i)
    image[map.base.variables[i]] = symmetry.variables[i];
  for (std::size_t i = 0; i < symmetry.parameters.size(); ++i)
    image[map.base.parameters[i]] = symmetry.parameters[i];
  return image;
}

/// The derivatives of functions by symbols.
PolynomialRows derivatives_of(Prover& prover, const std::vector<ex>& functions,
                              const std::vector<GiNaC::symbol>& by) {
  const FunctionRing& ring = prover.ring();
  PolynomialRows rows;
  for (const ex& value : functions) {
    auto& row = rows.emplace_back();
    for (const GiNaC::symbol& s : by) {
      const auto place = std::ranges::find_if(
          ring.symbols(), [&](const GiNaC::symbol& other) { return other.is_equal(s); });
      row.push_back(ring.derivative(prover.convert(value),
                                    static_cast<std::size_t>(place - ring.symbols().begin())));
    }
  }
  return rows;
}

/// Hypothesis of a symmetry and of a conjugacy S: it is a local diffeomorphism near almost all
/// points, by the theorem on inverse functions where its Jacobian determinant is zero on no piece
/// of its domain. Without it a constant S, to a fixed point, would be a symmetry of every map, a
/// reversal too, and a conjugacy to every map.
void judge_invertible(Prover& prover, Proof& proof, const std::string& name,
                      const std::vector<ex>& functions, const std::vector<GiNaC::symbol>& by) {
  if (proof.verdict != Verdict::proved) return;
  const PolynomialRows rows = derivatives_of(prover, functions, by);
  const auto found = rank_with_conditions(prover, rows);
  if (found && found->uneven.empty() && found->exact && found->rank == rows.size()) {
    proof.where.insert(proof.where.end(), found->nonzero.begin(), found->nonzero.end());
    if (!found->where.empty()) proof.where.push_back(found->where);
    return;
  }
  const bool singular = found && found->uneven.empty() && found->exact;
  proof.verdict = singular ? Verdict::refuted : Verdict::undecided;
  proof.reason = singular ? fmt::format(
                                "'{}' is not invertible: the rank of its Jacobian matrix is {}, "
                                "not {}",
                                name, found->rank, rows.size())
                          : fmt::format("'{}' is not shown to be invertible", name);
}

constexpr const char* kLocally = "locally: near almost all points it is invertible";

/// An affine map that is invertible somewhere is so everywhere; x -> |x| commutes with x -> x + 1.
bool is_affine(const std::vector<ex>& images, const std::vector<GiNaC::symbol>& variables) {
  return std::ranges::all_of(images, [&](const ex& image) {
    return std::ranges::all_of(variables, [&](const GiNaC::symbol& x) {
      const ex slope = image.diff(x).expand();
      return std::ranges::none_of(variables, [&](const GiNaC::symbol& y) { return slope.has(y); });
    });
  });
}

/// The gradients of constraints at f(x), for those at x.
std::function<PolynomialRows(const PolynomialRows&)> slopes_at(Prover& prover, GiNaC::exmap image) {
  return [&prover, image = std::move(image)](const PolynomialRows& slopes) {
    const FunctionRing& ring = prover.ring();
    PolynomialRows result;
    for (const auto& slope : slopes) {
      auto& row = result.emplace_back();
      for (const Polynomial& p : slope)
        row.push_back(prover.convert(substituted(ring.expression(p), image, ring.limits())));
    }
    return result;
  };
}

/// Hypothesis of a symmetry on constraints, which may be singular on them though it is not beside
/// them: the parameters that it carries along and, for fixed ones, the state can be told from their
/// images.
void judge_symmetry_on_constraints(Prover& prover, Proof& proof, const MapModel& map,
                                   const MapSymmetry& symmetry) {
  if (!symmetry.parameters.empty())
    judge_invertible(prover, proof, symmetry.name, symmetry.parameters, map.base.parameters);
  if (proof.verdict != Verdict::proved) return;
  require_local_inverse_on_constraints(
      prover, proof, {derivatives_of(prover, symmetry.variables, map.base.variables)},
      slopes_at(prover, image_of(map, symmetry)));
  if (proof.verdict != Verdict::proved)
    proof.reason =
        fmt::format("'{}' is not shown to be invertible on the constraints", symmetry.name);
  else if (!is_affine(symmetry.variables, map.base.variables))
    proof.evidence = kLocally;
}

/// What has to vanish on the constraints for map and symmetry to stay there.
std::vector<Residual> constraints_left(Prover& prover, const MapModel& map,
                                       const MapSymmetry& symmetry) {
  std::vector<Residual> residuals = level_images(prover, map, map.base.constraints);
  const GiNaC::exmap image = image_of(map, symmetry);
  for (const NamedExpression& c : map.base.constraints)
    residuals.push_back(difference(prover,
                                   fmt::format("{} where '{}' leads", c.name, symmetry.name),
                                   substituted(c.value, image, map.base.limits)));
  return residuals;
}

/// Why nothing is said of a symmetry; empty where something is. What is assumed may be wrong where
/// S leads, unless S changes nothing of that, or multiplies it by a positive number.
std::string why_not_symmetry(const MapModel& map, const MapSymmetry& symmetry) {
  const auto is_kept = [&](const Assumption& assumption) {
    const ex image = substituted(assumption.difference, image_of(map, symmetry), map.base.limits);
    return std::ranges::any_of(map.base.assumptions, [&](const Assumption& other) {
      const ex ratio = normal_form(image / other.difference);
      return other.comparison == assumption.comparison && GiNaC::is_a<GiNaC::numeric>(ratio) &&
             (GiNaC::ex_to<GiNaC::numeric>(ratio).is_positive() ||
              (other.comparison == Comparison::unequal && !ratio.is_zero()));
    });
  };
  for (const Assumption& assumption : map.base.assumptions)
    if (!is_kept(assumption))
      return fmt::format("whether '{}' keeps {} is not known", symmetry.name, assumption.text);
  return {};
}

std::string symmetry_name(const MapSymmetry& symmetry) {
  return symmetry.name + (symmetry.reverses ? ", reversal" : ", symmetry");
}

/// phi(S(x)) = S(phi(x)), or phi(S(phi(x))) = S(x), and S is invertible. The parameters are carried
/// along by S.
Claim whole_symmetry_claim(const MapModel& map, const MapSymmetry& symmetry) {
  const GiNaC::exmap image = image_of(map, symmetry);
  std::vector<ex> left, right;
  for (std::size_t i = 0; i < map.next.size(); ++i) {
    const ex after = substituted(map.next[i], image, map.base.limits);
    left.push_back(symmetry.reverses ? map.composed(after) : after);
    right.push_back(symmetry.reverses ? symmetry.variables[i]
                                      : map.composed(symmetry.variables[i]));
  }
  Claim claim{ClaimKind::map, symmetry_name(symmetry), false,
              [&map, symmetry, left, right](Prover& prover, Proof& proof) {
                proof.reason = why_not_symmetry(map, symmetry);
                if (!proof.reason.empty()) return;
                const bool constrained = !map.base.constraints.empty();
                std::vector<Residual> residuals = constraints_left(prover, map, symmetry);
                for (std::size_t i = 0; i < left.size(); ++i)
                  residuals.push_back(difference(
                      prover, fmt::format("the difference in {}", map.base.variables[i].get_name()),
                      left[i] - right[i]));
                prover.decide(proof, residuals, prover.level(map.base.constraints));
                if (constrained) return judge_symmetry_on_constraints(prover, proof, map, symmetry);
                std::vector<ex> images = symmetry.variables;
                images.insert(images.end(), symmetry.parameters.begin(), symmetry.parameters.end());
                std::vector<GiNaC::symbol> by = map.base.symbols();
                judge_invertible(prover, proof, symmetry.name, images, by);
                if (proof.verdict == Verdict::proved && !is_affine(images, by))
                  proof.evidence = kLocally;
              }};
  claim.expressions = domain_of(map, map.base.constraints);
  for (const NamedExpression& c : map.base.constraints)
    append(claim.expressions, substituted_with_parts(c.value, image, map.base.limits));
  // The map where S leads, and S where the map leads; of a reversal, the map at S(phi(x)).
  std::vector<ex> parts = symmetry.domain;
  append(parts, symmetry.variables);
  for (const auto* list : {&map.next, &map.next_domain})
    for (const ex& f : *list) append(parts, substituted_with_parts(f, image, map.base.limits));
  for (const ex& part : parts) {
    claim.expressions.push_back(part);
    append(claim.expressions, map.composed_with_parts(part));
  }
  claim.subject = Subject::functions;
  return claim;
}

}  // namespace

Claim symmetry_claim(const MapModel& map, const MapSymmetry& symmetry) {
  return or_without_value(ClaimKind::map, symmetry_name(symmetry),
                          [&] { return whole_symmetry_claim(map, symmetry); });
}

namespace {

/// phi at the points that the map leads to, and the other map and what it is defined by at phi.
struct Conjugated {
  std::vector<ex> after, other, parts;
};

Conjugated conjugated(const MapModel& map, const MapConjugacy& conjugacy) {
  Conjugated result;
  for (const ex& y : conjugacy.expressions) result.after.push_back(map.composed(y));
  GiNaC::exmap at;
  for (std::size_t i = 0; i < conjugacy.coordinates.size(); ++i)
    at[conjugacy.coordinates[i]] = conjugacy.reverses ? result.after[i] : conjugacy.expressions[i];
  for (const ex& y : conjugacy.map) result.other.push_back(substituted(y, at, map.base.limits));
  for (const auto* list : {&conjugacy.map, &conjugacy.map_domain})
    for (const ex& f : *list) append(result.parts, substituted_with_parts(f, at, map.base.limits));
  return result;
}

/// Why nothing is said of conjugacies; empty where something is. A map may leave the domain that
/// its signs are taken from.
std::string why_not_conjugated(const Model& model) {
  for (const Assumption& assumption : model.assumptions)
    for (const GiNaC::symbol& x : model.variables)
      if (assumption.difference.has(x)) return "whether the map stays in the domain is not known";
  return {};
}

/// Hypothesis of a conjugacy phi: it is invertible where the map leads, too. Else a map into points
/// where phi is singular would be conjugate to every map of the one value that phi has there. Shown
/// where D(phi F) = Dphi(F) DF has the full rank on each piece.
void judge_invertible_at_image(Prover& prover, Proof& proof, const MapModel& map,
                               const MapConjugacy& conjugacy, const std::vector<ex>& after) {
  if (proof.verdict != Verdict::proved) return;
  Proof there;
  there.verdict = Verdict::proved;
  judge_invertible(prover, there, conjugacy.name, after, map.base.variables);
  if (there.verdict == Verdict::proved) {
    proof.evidence = kLocally;
    add_conditions(proof, there.where);
    return;
  }
  proof.verdict = Verdict::undecided;
  proof.reason =
      fmt::format("'{}' is not shown to be invertible where the map leads", conjugacy.name);
}

/// The same on constraints, where phi may be singular though it is not beside them: there it is
/// asked for phi, and for phi F, and that F leads to where the constraints are as smooth.
void judge_conjugacy_on_constraints(Prover& prover, Proof& proof, const MapModel& map,
                                    const MapConjugacy& conjugacy, const std::vector<ex>& after) {
  if (proof.verdict != Verdict::proved) return;
  GiNaC::exmap next;
  for (std::size_t i = 0; i < map.next.size(); ++i) next[map.base.variables[i]] = map.next[i];
  require_local_inverse_on_constraints(
      prover, proof,
      {derivatives_of(prover, conjugacy.expressions, map.base.variables),
       derivatives_of(prover, after, map.base.variables)},
      slopes_at(prover, next));
  if (proof.verdict == Verdict::proved)
    proof.evidence = kLocally;
  else
    proof.reason =
        fmt::format("'{}' is not shown to be invertible on the constraints", conjugacy.name);
}

/// phi(F(x)) = G(phi(x)), or G(phi(F(x))) = phi(x), where both sides have values, and phi is
/// invertible near almost all points, and near those to which these are taken.
Claim whole_conjugacy_claim(const MapModel& map, const MapConjugacy& conjugacy) {
  const Conjugated at = conjugated(map, conjugacy);
  const std::vector<ex>& expected = conjugacy.reverses ? conjugacy.expressions : at.after;
  Claim claim{
      ClaimKind::conjugacy, conjugacy.name, false,
      [&map, conjugacy, expected, at](Prover& prover, Proof& proof) {
        proof.reason = why_not_conjugated(map.base);
        if (!proof.reason.empty()) return;
        std::vector<Residual> residuals = level_images(prover, map, map.base.constraints);
        for (std::size_t i = 0; i < at.other.size(); ++i)
          residuals.push_back(difference(
              prover, fmt::format("the difference in {}", conjugacy.coordinates[i].get_name()),
              expected[i] - at.other[i]));
        prover.decide(proof, residuals, prover.level(map.base.constraints));
        if (!map.base.constraints.empty())
          return judge_conjugacy_on_constraints(prover, proof, map, conjugacy, at.after);
        judge_invertible(prover, proof, conjugacy.name, conjugacy.expressions, map.base.variables);
        judge_invertible_at_image(prover, proof, map, conjugacy, at.after);
      }};
  claim.expressions = domain_of(map, map.base.constraints);
  for (const auto* list : {&conjugacy.expressions, &conjugacy.domain}) {
    for (const ex& part : *list) {
      claim.expressions.push_back(part);
      append(claim.expressions, map.composed_with_parts(part));
    }
  }
  append(claim.expressions, at.parts);
  claim.subject = Subject::functions;
  return claim;
}

}  // namespace

Claim conjugacy_claim(const MapModel& map, const MapConjugacy& conjugacy) {
  return or_without_value(ClaimKind::conjugacy, conjugacy.name,
                          [&] { return whole_conjugacy_claim(map, conjugacy); });
}

}  // namespace casimir::discrete
