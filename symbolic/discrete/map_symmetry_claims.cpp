// That a map has a symmetry or a reversal, or is conjugate to another map.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/map_claims.hpp"
#include "symbolic/expression/expression.hpp"
#include "symbolic/expression/expression_size.hpp"
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

/// Why nothing is said of a symmetry; empty where something is. On constraints S may be singular
/// though it is not beside them, and it may lead out of them; and what is assumed may be wrong
/// where it leads, unless S changes nothing of that, or multiplies it by a positive number.
std::string why_not_symmetry(const MapModel& map, const MapSymmetry& symmetry) {
  if (!map.base.constraints.empty())
    return fmt::format(
        "whether '{}' keeps the constraints, and is invertible on them, is not known",
        symmetry.name);
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
                std::vector<Residual> residuals;
                for (std::size_t i = 0; i < left.size(); ++i)
                  residuals.push_back(
                      difference(prover, map.base.variables[i].get_name(), left[i] - right[i]));
                prover.decide(proof, residuals, {});
                std::vector<ex> images = symmetry.variables;
                images.insert(images.end(), symmetry.parameters.begin(), symmetry.parameters.end());
                std::vector<GiNaC::symbol> by = map.base.symbols();
                judge_invertible(prover, proof, symmetry.name, images, by);
              }};
  claim.expressions = domain_of(map, {});
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

/// Why nothing is said of conjugacies; empty where something is. On constraints phi may be singular
/// though it is not beside them, and a map may leave the domain that its signs are taken from.
std::string why_not_conjugated(const Model& model) {
  if (!model.constraints.empty()) return "whether it is invertible on the constraints is not known";
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
    proof.evidence = "locally: near almost all points it is invertible";
    add_conditions(proof, there.where);
    return;
  }
  proof.verdict = Verdict::undecided;
  proof.reason =
      fmt::format("'{}' is not shown to be invertible where the map leads", conjugacy.name);
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
        std::vector<Residual> residuals;
        for (std::size_t i = 0; i < at.other.size(); ++i)
          residuals.push_back(
              difference(prover, conjugacy.coordinates[i].get_name(), expected[i] - at.other[i]));
        prover.decide(proof, residuals, {});
        judge_invertible(prover, proof, conjugacy.name, conjugacy.expressions, map.base.variables);
        judge_invertible_at_image(prover, proof, map, conjugacy, at.after);
      }};
  claim.expressions = domain_of(map, {});
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
