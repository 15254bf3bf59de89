// Invariant measures of maps.
#include "symbolic/discrete/map_measure_claim.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "symbolic/discrete/map_claim_parts.hpp"
#include "symbolic/discrete/map_inverse.hpp"
#include "symbolic/discrete/map_jacobian.hpp"
#include "symbolic/proof/claims/density.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"

namespace casimir::discrete {
namespace {

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

/// Hypotheses of a measure density*dx/dc: at a point of each part of the constraints their
/// gradients are independent, so that dx/dc has a meaning, and det A is not zero. Where it is, so
/// is the Jacobian determinant, which says nothing then of what the map does on them: (2 x, z^2)
/// doubles the lengths on z = 0.
/// \param where  becomes the parts of them of which that is known
bool have_a_measure(Prover& prover, const ChangeAcross& across, std::vector<std::string>& where) {
  if (prover.model().constraints.empty()) return true;
  PolynomialRows slopes;
  for (const NamedExpression& c : prover.model().constraints)
    slopes.push_back(prover.gradient(prover.convert(c.value)));
  const std::size_t count = slopes.size();
  Proof proof;
  proof.verdict = Verdict::proved;
  require_on_constraints(prover, proof, {{std::move(slopes), count}, {{{across.top}}, 1}});
  where = std::move(proof.where);
  return proof.verdict == Verdict::proved;
}

/// The determinant of the scalar products of the gradients of the constraints, 1 without any: zero
/// where they are dependent.
Polynomial gram_determinant(Prover& prover) {
  const FunctionRing& ring = prover.ring();
  std::vector<std::vector<Polynomial>> slopes, products;
  for (const NamedExpression& c : prover.model().constraints)
    slopes.push_back(prover.gradient(prover.convert(c.value)));
  for (const auto& a : slopes) {
    auto& row = products.emplace_back();
    for (const auto& b : slopes) {
      Polynomial sum = ring.ring().constant(0);
      for (std::size_t i = 0; i < a.size(); ++i) sum += ring.checked_product(a[i], b[i]);
      row.push_back(std::move(sum));
    }
  }
  return products.empty() ? ring.ring().constant(1) : determinant(ring.ring(), products);
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

/// What the map does to the orientation that a density gives.
enum class Orientation { kept, reversed, differs };

/// Decides whether image = own, or image = -own, at each point where the gradients of the
/// constraints are independent.
///
/// At a point where the one fails the other may hold, as of a map that reflects one half of the
/// plane: where functions change their signs, or constraints have several parts, nothing is refuted
/// but by their product.
class MeasureEquation {
 public:
  MeasureEquation(Prover& prover, const MapModel& map, const NamedExpression& density,
                  const ChangeAcross& across)
      : prover_(prover),
        map_(map),
        density_(density),
        across_(across),
        level_(prover.level(map.base.constraints)),
        image_(prover.convert(map.composed(density.value)) *
               determinant(prover.ring().ring(), jacobian(prover, map)) * across.bottom),
        own_(prover.convert(density.value) * across.top) {}

  Orientation decide(Proof& proof) const {
    const Proof blank = proof;
    const bool reversed = !prover_.is_zero(image_ - own_) && prover_.is_zero(image_ + own_);
    prover_.decide(proof, {residual(reversed ? -1 : 1)}, level_);
    if (proof.verdict == Verdict::proved)
      return reversed ? Orientation::reversed : Orientation::kept;
    if (level_.empty())
      return prover_.ring().is_polynomial() ? Orientation::kept : decide_product(proof, blank);
    Proof opposite = blank;
    prover_.decide(opposite, {residual(-1)}, level_);
    if (opposite.verdict != Verdict::proved) return decide_product(proof, blank);
    proof = std::move(opposite);
    return Orientation::reversed;
  }

 private:
  Orientation decide_product(Proof& proof, const Proof& blank) const {
    if (proof.verdict != Verdict::refuted) return Orientation::kept;
    const FunctionRing& ring = prover_.ring();
    const Polynomial gram = gram_determinant(prover_);
    const Polynomial product = (image_ - own_) * (image_ + own_) * gram;
    Proof either = blank;
    prover_.decide(
        either,
        {{fmt::format("the square of ({}) at the next point times the Jacobian "
                      "determinant, less that of itself{}",
                      density_.name, times()),
          product,
          [this, gram] { return (by_ginac(1) * by_ginac(-1)) * prover_.ring().expression(gram); }}},
        level_);
    // A point at which the product is not zero says the same as one of the difference.
    if (level_.empty() && either.verdict == Verdict::refuted && !ring.rests_on_what_was_converted())
      return Orientation::kept;
    proof = std::move(either);
    return Orientation::differs;
  }

  Residual residual(int sign) const {
    return {fmt::format("({}) at the next point times the Jacobian determinant, {} itself{}",
                        density_.name, sign > 0 ? "less" : "plus", times()),
            sign > 0 ? image_ - own_ : image_ + own_, [this, sign] { return by_ginac(sign); }};
  }

  std::string times() const { return across_.is_one ? "" : " times that of the constraints"; }

  GiNaC::ex by_ginac(int sign) const {
    const FunctionRing& ring = prover_.ring();
    return map_.composed(density_.value) * jacobian_determinant(map_) *
               ring.expression(across_.bottom) -
           sign * density_.value * ring.expression(across_.top);
  }

  Prover& prover_;
  const MapModel& map_;
  const NamedExpression& density_;
  const ChangeAcross& across_;
  const Level& level_;
  Polynomial image_, own_;
};

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
  if (!have_a_measure(prover, *across, where)) {
    proof.reason =
        "no exact point was found at which the gradients of the constraints are independent, and "
        "the map takes none of their directions to zero, without which nothing is said of "
        "density*dx/dc";
    return;
  }
  const Orientation orientation = MeasureEquation(prover, map, density, *across).decide(proof);
  constexpr double kFewTerms = 1000;
  const bool one_to_one = is_one_to_one(map, kFewTerms);
  if (proof.verdict == Verdict::refuted && !one_to_one) excuse(proof, density.name);
  judge_density(prover, proof, density.value);
  if (proof.verdict != Verdict::proved) return;
  add_conditions(proof, where);
  if (orientation != Orientation::kept)
    proof.evidence += fmt::format("{}the map reverses the orientation that the density gives{}",
                                  proof.evidence.empty() ? "" : "; ",
                                  orientation == Orientation::differs ? " at some points" : "");
  // Of a map that is not one to one the preimage of a set may have several parts, and their
  // measure is that of the set only one by one: (x^2, y/(2*x)) doubles areas.
  if (!one_to_one) proof.where.emplace_back("on sets on which the map is one to one");
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
