// Invariant measures of maps.
#include "symbolic/discrete/map_measure_claim.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/map_inverse.hpp"
#include "symbolic/discrete/map_jacobian.hpp"
#include "symbolic/proof/claims/density.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"

namespace casimir::discrete {
namespace {

/// Whether rho(x') det is rho(x) at some points and -rho(x) at others, as of a map that reflects
/// one half of the plane; then the claim, which was decided for one sign, is proved. At a point
/// where the one is refuted the other may hold: where signs of functions may change, nothing is
/// refuted that is not for their product.
bool has_another_sign_on_pieces(Prover& prover, Proof& proof, const Polynomial& image,
                                const Polynomial& own) {
  if (proof.verdict != Verdict::refuted || prover.ring().is_polynomial()) return false;
  Proof both;
  both.kind = proof.kind;
  both.name = proof.name;
  const Polynomial product = (image - own) * (image + own);
  prover.decide(
      both,
      {{"the square of the density at the next point times the Jacobian determinant, less "
        "that of itself",
        product, [&prover, product] { return prover.ring().expression(product); }}},
      {});
  if (both.verdict == Verdict::refuted && !prover.ring().rests_on_what_was_converted())
    return false;
  proof = std::move(both);
  return proof.verdict == Verdict::proved;
}

/// det A of c(x') = A c, as a quotient.
struct ChangeAcross {
  Polynomial top, bottom;
  bool is_one = true;  ///< the constraints are functions that the map keeps, on all their levels
};

/// How the map changes dc_1 .. dc_k on the common zero level of the constraints, where polynomial
/// division finds such an A; 1 without constraints. Where dc_1 .. dc_k are independent, A is unique
/// there.
std::optional<ChangeAcross> change_across(Prover& prover, const MapModel& map) {
  const FunctionRing& ring = prover.ring();
  const Polynomial zero = ring.ring().constant(0), one = ring.ring().constant(1);
  ChangeAcross result{one, one};
  std::vector<Polynomial> constraints;
  for (const NamedExpression& c : map.base.constraints) {
    const auto [top, bottom] = ring.lowest_terms(prover.convert(c.value));
    if (top.is_zero() || !bottom.is_constant()) return std::nullopt;
    constraints.push_back(prover.convert(c.value));
    result.is_one =
        result.is_one && prover.is_zero(prover.convert(map.composed(c.value)) - constraints.back());
  }
  if (result.is_one) return result;
  std::vector<std::vector<Polynomial>> matrix;
  for (const NamedExpression& c : map.base.constraints) {
    const auto [image, below] = ring.lowest_terms(prover.convert(map.composed(c.value)));
    auto& row = matrix.emplace_back(constraints.size(), zero);
    if (!image.is_zero() && !image.remainder(constraints, &row).is_zero()) return std::nullopt;
    if (!ring.is_nowhere_zero(below) && !prover.is_nowhere_zero_on_constraints(below))
      return std::nullopt;
    result.bottom *= below;
  }
  result.top = determinant(ring.ring(), matrix);
  return result;
}

/// Whether dx/dc has a meaning: somewhere on the constraints their gradients are independent.
/// \param where  becomes the parts of them of which that is known
bool are_independent(Prover& prover, std::vector<std::string>& where) {
  PolynomialRows slopes;
  for (const NamedExpression& c : prover.model().constraints)
    slopes.push_back(prover.gradient(prover.convert(c.value)));
  const std::size_t count = slopes.size();
  Proof proof;
  proof.verdict = Verdict::proved;
  require_on_constraints(prover, proof, {{std::move(slopes), count}});
  where = std::move(proof.where);
  return proof.verdict == Verdict::proved;
}

/// A map that is not one to one may keep a measure that it does not keep near each point.
void excuse(Proof& proof, const std::string& density) {
  proof.reason = fmt::format(
      "the map does not keep ({}) times the volume near each point, but it is not shown to be "
      "one to one: the preimage of a set may have several parts that make up for it",
      density);
  proof.verdict = Verdict::undecided;
  proof.residual.clear();
  proof.witness.reset();
}

/// By the change of variables x' = phi(x) the measure |rho| dx is kept, near every point at which
/// the Jacobian determinant is not zero, exactly where rho(x') det(dx'/dx) is rho(x) or -rho(x).
/// On the zero level of constraints, with c(x') = A c, the measure |rho| dx/dc is exactly where
/// this is rho(x) det A or its opposite. Globally, where the map is one to one besides.
void decide_measure(Prover& prover, Proof& proof, const MapModel& map,
                    const NamedExpression& density) {
  const auto across = change_across(prover, map);
  if (!across) {
    proof.reason = kNoMeasureOnConstraints;
    return;
  }
  std::vector<std::string> where;
  if (!are_independent(prover, where)) {
    proof.reason =
        "no exact point was found at which the gradients of the constraints are independent, "
        "without which there is no measure density*dx/dc";
    return;
  }
  const Polynomial image = prover.convert(map.composed(density.value)) *
                           determinant(prover.ring().ring(), jacobian(prover, map)) *
                           across->bottom;
  const Polynomial own = prover.convert(density.value) * across->top;
  const auto residual = [&](int sign) -> Residual {
    const std::string label = fmt::format(
        "({}) at the next point times the Jacobian determinant, {} itself{}", density.name,
        sign > 0 ? "less" : "plus", across->is_one ? "" : " times that of the constraints");
    const Polynomial value = sign > 0 ? image - own : image + own;
    if (!across->is_one)
      return {label, value, [&prover, value] { return prover.ring().expression(value); }};
    return {label, value, [&map, density, sign] {
              return map.composed(density.value) * jacobian_determinant(map) - sign * density.value;
            }};
  };
  const Level& level = prover.level(map.base.constraints);
  bool reverses = !prover.is_zero(image - own) && prover.is_zero(image + own);
  prover.decide(proof, {residual(reverses ? -1 : 1)}, level);
  if (proof.verdict != Verdict::proved && !level.empty()) {
    Proof opposite;
    opposite.kind = proof.kind;
    opposite.name = proof.name;
    prover.decide(opposite, {residual(-1)}, level);
    reverses = opposite.verdict == Verdict::proved;
    if (reverses) proof = std::move(opposite);
  }
  const bool bends = has_another_sign_on_pieces(prover, proof, image, own);
  constexpr double kFewTerms = 1000;
  const bool one_to_one = is_one_to_one(map, kFewTerms);
  if (proof.verdict == Verdict::refuted && !one_to_one) excuse(proof, density.name);
  judge_density(prover, proof, density.value);
  if (proof.verdict != Verdict::proved) return;
  add_conditions(proof, where);
  const auto add = [&](const char* text) {
    proof.evidence += std::string(proof.evidence.empty() ? "" : "; ") + text;
  };
  if (reverses || bends)
    add(bends ? "the map reverses the orientation that the density gives at some points"
              : "the map reverses the orientation that the density gives");
  // Of a map that is not one to one the preimage of a set may have several parts, and their
  // measure is that of the set only one by one: (x^2, y/(2*x)) doubles areas.
  if (!one_to_one) proof.where.push_back("on sets on which the map is one to one");
}

}  // namespace

Claim measure_claim_of_one_map(const MapModel& map, const NamedExpression& density) {
  Claim claim{ClaimKind::measure, density.name, false,
              [&map, density](Prover& prover, Proof& proof) {
                decide_measure(prover, proof, map, density);
              }};
  std::vector<NamedExpression> all = map.base.constraints;
  all.push_back(density);
  claim.expressions = domain_of(map, all);
  claim.subject = Subject::functions;
  return claim;
}

}  // namespace casimir::discrete
