// Liouville's theorem: integrals in involution that are independent on the generic leaf, as many as
// half its dimension, or more that need not commute.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/claims/real_functions.hpp"
#include "symbolic/proof/claims/superintegrability.hpp"
#include "symbolic/proof/special_parameters.hpp"

namespace casimir {
namespace {

/// Whether the bracket of two functions vanishes, or does on constraints that are Casimir
/// functions.
bool commute(Prover& prover, const NamedExpression& f, const NamedExpression& g) {
  const Polynomial bracket = prover.bracket(f.value, g.value);
  if (prover.is_zero(bracket)) return true;
  const Model& model = prover.model();
  const auto constant = [&](const NamedExpression& c) { return is_casimir(prover, c); };
  if (model.constraints.empty() || !std::ranges::all_of(model.constraints, constant)) return false;
  Proof proof;
  prover.decide(
      proof, {{"their bracket", bracket, [&] { return model.poisson->bracket(f.value, g.value); }}},
      prover.level(model.constraints));
  return proof.verdict == Verdict::proved && proof.where.empty();
}

/// For each function the set of those that it commutes with, itself included.
std::vector<unsigned> commuting(Prover& prover, const std::vector<NamedExpression>& functions) {
  std::vector<unsigned> sets(functions.size());
  for (std::size_t i = 0; i < functions.size(); ++i) {
    sets[i] |= 1U << i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!commute(prover, functions[i], functions[j])) continue;
      sets[i] |= 1U << j;
      sets[j] |= 1U << i;
    }
  }
  return sets;
}

/// The flows of a set of functions in involution; nothing where they are not.
std::optional<PolynomialRows> flows_in_involution(unsigned set,
                                                  const std::vector<unsigned>& commutes,
                                                  const PolynomialRows& flows) {
  PolynomialRows rows;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    if ((set >> i & 1U) == 0) continue;
    if ((set & ~commutes[i]) != 0) return std::nullopt;
    rows.push_back(flows[i]);
  }
  return rows;
}

/// The largest set, up to `needed`, of functions in involution with the first one whose fields have
/// independent values.
unsigned largest_set(const std::vector<unsigned>& commutes, RealPoint& point,
                     const PolynomialRows& flows, std::size_t needed) {
  unsigned best = 0;
  const auto size = [](unsigned set) { return static_cast<std::size_t>(std::popcount(set)); };
  for (unsigned set = 1; set < (1U << flows.size()) && size(best) < needed; set += 2) {
    if (size(set) <= size(best) || size(set) > needed) continue;
    const auto rows = flows_in_involution(set, commutes, flows);
    if (rows && point.rank(*rows) == rows->size()) best = set;
  }
  return best;
}

/// Sets of functions in involution, one for each piece of the domain.
struct SetsOnPieces {
  bool complete = false;      ///< each has as many as are needed
  std::size_t least = 0;      ///< of the piece with the smallest set
  unsigned set = 0;           ///< the same on all pieces; 0 where there is none
  std::vector<RealPoint> at;  ///< a point on each; or on the one with too few
  std::string where;
};

/// A set of `needed` functions in involution, the first among them, that are independent on each
/// piece: at one point of a rigid one, at all points of another. (On p < 0 it may be |p| - p that
/// counts, and |p| + p on p > 0.) Or 0.
unsigned set_on_all(std::vector<PiecePoints::Piece>& pieces, const std::vector<unsigned>& commutes,
                    const PolynomialRows& flows, std::size_t needed) {
  for (unsigned set = 1; set < (1U << flows.size()); set += 2) {
    if (static_cast<std::size_t>(std::popcount(set)) != needed) continue;
    const auto rows = flows_in_involution(set, commutes, flows);
    if (!rows) continue;
    const auto independent = [&](RealPoint& point) { return point.rank(*rows) == needed; };
    if (std::ranges::all_of(pieces, [&](PiecePoints::Piece& piece) {
          return piece.rigid ? std::ranges::any_of(piece.points, independent)
                             : std::ranges::all_of(piece.points, independent);
        }))
      return set;
  }
  return 0;
}

SetsOnPieces sets_on_pieces(Prover& prover, const PolynomialRows& flows,
                            const std::vector<unsigned>& commutes, std::size_t needed) {
  std::vector<Polynomial> entries;
  for (const auto& row : flows) entries.insert(entries.end(), row.begin(), row.end());
  PiecePoints found(prover, entries);
  SetsOnPieces result;
  if (needed == 0 || found.pieces().empty()) return result;
  result.where = found.where();
  const auto size = [](unsigned set) { return static_cast<std::size_t>(std::popcount(set)); };
  // Of a rigid piece one point is enough, of another one all have to do.
  const auto on_piece = [&](PiecePoints::Piece& piece) {
    std::optional<std::size_t> best;
    for (RealPoint& point : piece.points) {
      const unsigned set = largest_set(commutes, point, flows, needed);
      const bool better = !best || (piece.rigid ? size(set) > *best : size(set) < *best);
      if (!better) continue;
      best = size(set);
      if (*best >= needed && piece.rigid) break;
    }
    return *best;
  };
  do {
    result.complete = true;
    result.at.clear();
    result.least = needed;
    for (PiecePoints::Piece& piece : found.pieces()) {
      const std::size_t own = on_piece(piece);
      if (own < result.least) {
        result.least = own;
        result.complete = false;
        result.at = {piece.points.front()};
        break;
      }
      result.at.push_back(piece.points.back());
    }
  } while (!result.complete && found.add_point());
  if (result.complete) result.set = set_on_all(found.pieces(), commutes, flows, needed);
  return result;
}

/// So many functions in involution, the first among them, whose flows are independent whatever the
/// arbitrary functions are.
std::optional<unsigned> always_independent_set(const Prover& prover, const PolynomialRows& flows,
                                               const std::vector<unsigned>& commutes,
                                               std::size_t needed) {
  if (!has_arbitrary_functions(prover.model())) return std::nullopt;
  for (unsigned set = 1; set < (1U << flows.size()); set += 2) {  // with the first, the Hamiltonian
    if (static_cast<std::size_t>(std::popcount(set)) != needed) continue;
    const auto rows = flows_in_involution(set, commutes, flows);
    if (rows && are_always_independent(prover, *rows)) return set;
  }
  return std::nullopt;
}

/// Why so many functions are not counted on the generic leaf: a sentence, or nothing.
std::string why_not_counted(const std::optional<GenericRank>& leaf, std::size_t functions) {
  if (!leaf) return "no point of the domain was found to take the rank of the bracket at";
  if (!leaf->uneven.empty()) return leaf->uneven;
  if (!leaf->exact)
    return fmt::format("the leaves are only known to have dimension {} or more", leaf->rank);
  constexpr std::size_t kMaxFunctions = 16;
  if (functions > kMaxFunctions)
    return fmt::format("more than {} integrals: their choice is not searched", kMaxFunctions);
  const std::size_t needed = leaf->rank / 2;
  if (functions >= needed) return {};
  return fmt::format("leaves of dimension {} need {} independent integrals in involution; {} known",
                     leaf->rank, needed, functions);
}

/// Integrals in involution that are independent on the generic leaf: as many as half its dimension?
void decide_liouville(Prover& prover, Proof& proof) {
  if (has_complex_motion(prover)) {
    proof.reason = "the Hamiltonian or the bracket is not real";
    return;
  }
  std::vector<NamedExpression> functions = real_ones(prover, with_hamiltonian(prover.model(), {}));
  const std::string first = functions.empty() ? "" : functions.front().name;
  const std::string left_out = take_out_jumping(prover, functions);
  // All others have to commute with the Hamiltonian.
  if (!first.empty() && (functions.empty() || functions.front().name != first)) {
    proof.reason = left_out.substr(2);
    return;
  }
  const auto leaf = bracket_rank(prover);
  proof.reason = why_not_counted(leaf, functions.size());
  if (!proof.reason.empty()) proof.reason += left_out;
  if (proof.reason.empty() && !is_poisson(prover))
    proof.reason =
        "the Jacobi identity is not proved at points where all functions of the claim have values";
  if (!proof.reason.empty()) return;
  const std::size_t needed = leaf->rank / 2;
  PolynomialRows flows;
  for (const NamedExpression& f : functions) flows.push_back(prover.flow(f.value));
  const std::vector<unsigned> commutes = commuting(prover, functions);
  if (const auto set = always_independent_set(prover, flows, commutes, needed)) {
    std::vector<NamedExpression> own;
    for (std::size_t i = 0; i < functions.size(); ++i)
      if ((*set >> i & 1U) != 0) own.push_back(functions[i]);
    proof.verdict = Verdict::proved;
    proof.evidence = fmt::format(
        "{} are in involution, and independent on leaves of dimension {}: a minor of their flows "
        "without the arbitrary functions is not zero",
        listed(own), leaf->rank);
    say_where(proof, leaf->where, leaf->nonzero);
    say_where(proof, "", where_beside_poles(prover, own));
    return;
  }
  const auto found = sets_on_pieces(prover, flows, commutes, needed);
  if (!found.complete) {
    proof.reason = fmt::format(
        "leaves of dimension {} need {} independent integrals in involution; {} known{}{}",
        leaf->rank, needed, found.least, found.at.empty() ? "" : " at " + text_of(found.at),
        left_out);
    return;
  }
  if (found.set == 0) {
    proof.reason = fmt::format(
        "there are enough integrals in involution on each part of the domain, but other ones (at "
        "{})",
        text_of(found.at));
    return;
  }
  std::vector<NamedExpression> chosen;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if ((found.set >> i & 1U) != 0) chosen.push_back(functions[i]);
  }
  proof.verdict = Verdict::proved;
  proof.evidence =
      chosen.size() == 1
          ? fmt::format("{} is enough on leaves of dimension {}; it is not constant at {}",
                        listed(chosen), leaf->rank, text_of(found.at))
          : fmt::format("{} are in involution and independent on leaves of dimension {} (at {})",
                        listed(chosen), leaf->rank, text_of(found.at));
  say_where(proof, leaf->where, leaf->nonzero);
  PolynomialRows own;
  for (const NamedExpression& f : chosen) own.push_back(prover.flow(f.value));
  say_where(proof, found.where != leaf->where ? found.where : "",
            needed_parameters(prover, own, needed));
  say_where(proof, "", where_beside_poles(prover, chosen));
  prover.say_where_values_are(proof);
  prover.check_inhabited(proof, {});
  require_on_constraints(prover, proof, {{structure_rows(prover), leaf->rank}, {own, needed}});
}

/// What a case that claims integrability has no count for is not proved by the rest of it.
Claim uncounted(const char* reason) {
  return {ClaimKind::liouville,
          "Liouville integrability",
          true,
          [reason](Prover&, Proof& proof) { proof.reason = reason; },
          {},
          {},
          false,
          Subject::functions};
}

}  // namespace

std::vector<Claim> liouville_claims(const Model& model) {
  if (!model.poisson || model.time) {
    if (!model.integrable) return {};
    return {uncounted(
        model.time ? "integrals are counted on the leaves of a bracket for motions that do not "
                     "depend on the time, and these do"
                   : "integrals are counted on the leaves of a Poisson bracket, and this case "
                     "has none")};
  }
  std::vector<Claim> claims{{ClaimKind::liouville,
                             "Liouville integrability",
                             true,
                             decide_liouville,
                             {},
                             values_of(with_hamiltonian(model, real_everywhere(model.casimirs))),
                             false,
                             model.hamiltonian ? Subject::motion : Subject::bracket}};
  if (!model.superintegrable) return claims;
  claims.push_back(claims.front());
  claims.back().name = "superintegrability";
  claims.back().decide = decide_superintegrability;
  claims.back().subject = Subject::motion;  // it asks which functions are integrals
  return claims;
}

}  // namespace casimir
