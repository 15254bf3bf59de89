// Functional independence, the rank of the bracket and the count of Liouville's theorem: facts that
// are read off exact ranks at a rational point.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <random>

#include "symbolic/algebra/rational_matrix.hpp"
#include "symbolic/model/given_functions.hpp"
#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/generic_rank.hpp"
#include "symbolic/proof/special_parameters.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> with_hamiltonian(const Model& model,
                                              std::vector<NamedExpression> functions) {
  if (model.hamiltonian && !model.time)
    functions.push_back({hamiltonian_name(model), *model.hamiltonian, {}});
  functions.insert(functions.end(), model.integrals.begin(), model.integrals.end());
  return functions;
}

std::string listed(const std::vector<NamedExpression>& functions) {
  return fmt::format("{}", fmt::join(names_of(functions), ", "));
}

PolynomialRows gradients(Prover& prover, const std::vector<NamedExpression>& functions) {
  PolynomialRows rows;
  for (const NamedExpression& f : functions)
    rows.push_back(prover.gradient(prover.convert(f.value)));
  return rows;
}

PolynomialRows structure_matrix(Prover& prover) {
  PolynomialRows rows;
  for (std::size_t i = 0; i < prover.dimension(); ++i) {
    rows.emplace_back();
    for (std::size_t j = 0; j < prover.dimension(); ++j)
      rows.back().push_back(prover.bracket_entry(i, j));
  }
  return rows;
}

/// A fact about some pieces of the domain only.
void say_where(Proof& proof, const std::string& where,
               const std::vector<std::string>& nonzero = {}) {
  if (!where.empty()) proof.where.push_back(where);
  for (const std::string& condition : nonzero) {
    if (std::find(proof.where.begin(), proof.where.end(), condition) == proof.where.end())
      proof.where.push_back(condition);
  }
}

/// Those of the functions whose rows add nothing to the ones before them, at all of these points.
std::vector<NamedExpression> dependent(const std::vector<NamedExpression>& functions,
                                       const PolynomialRows& rows, std::vector<RealPoint>& points) {
  std::vector<NamedExpression> result;
  PolynomialRows chosen;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    PolynomialRows more = chosen;
    more.push_back(rows[i]);
    const bool adds = std::any_of(points.begin(), points.end(), [&](RealPoint& point) {
      return point.rank(more) > chosen.size();
    });
    if (adds)
      chosen = std::move(more);
    else
      result.push_back(functions[i]);
  }
  return result;
}

/// Whether rows that contain arbitrary functions are independent for every choice of these, and all
/// values of the parameters.
///
/// Theorem: a minor of polynomials in the variables alone is not zero almost everywhere where it is
/// not zero at one point. Columns with anything else are left out: that makes ranks smaller only.
bool are_always_independent(const Prover& prover, const PolynomialRows& rows) {
  if (!has_arbitrary_functions(prover.model()) || rows.empty()) return false;
  const std::size_t dimension = prover.dimension(), places = prover.ring().ring().size();
  std::mt19937_64 random(11);
  std::vector<cln::cl_RA> point(places, 0);
  for (std::size_t i = 0; i < dimension; ++i) point[i] = static_cast<long>(random() % 1000) + 1;
  RationalMatrix values(rows.size());
  for (std::size_t j = 0; j < rows[0].size(); ++j) {
    const bool plain = std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
      for (std::size_t place = dimension; place < places; ++place)
        if (row[j].uses(place)) return false;
      return true;
    });
    for (std::size_t i = 0; i < rows.size() && plain; ++i)
      values[i].push_back(rows[i][j].evaluate(point));
  }
  return !values[0].empty() && rank(values) == rows.size();
}

void decide_independence(Prover& prover, Proof& proof,
                         const std::vector<NamedExpression>& functions) {
  const PolynomialRows slopes = gradients(prover, functions);
  if (are_always_independent(prover, slopes)) {
    proof.verdict = Verdict::proved;
    proof.evidence = "a minor of the gradients without the arbitrary functions is not zero";
    return;
  }
  // The flow of a function that commutes with all is orthogonal to all gradients.
  const auto kernel = [&] {
    std::vector<KernelCandidate> candidates;
    if (!prover.model().poisson) {
      if (!prover.model().field.empty()) candidates.push_back({prover.field()});  // a map has none
      return candidates;
    }
    for (const NamedExpression& f : functions) {
      candidates.push_back({prover.flow(f.value), [&](std::size_t i) {
                              return prover.is_zero(prover.bracket(functions[i].value, f.value));
                            }});
    }
    return candidates;
  };
  auto found = rank_with_conditions(prover, slopes, kernel);
  if (!found) {
    proof.reason = "no point of the domain was found to take the gradients at";
  } else if (!found->uneven.empty()) {
    proof.reason = found->uneven;
  } else if (found->rank == functions.size()) {
    proof.verdict = Verdict::proved;
    proof.evidence = found->points.empty()
                         ? "the gradients are constant and independent"
                         : "the gradients are independent at " + text_of(found->points);
    say_where(proof, found->where, found->nonzero);
    prover.check_inhabited(proof, {});
  } else if (found->exact) {
    proof.verdict = Verdict::refuted;
    proof.reason = fmt::format(
        "only {} of the {} functions are independent: every larger minor of their gradients "
        "vanishes identically",
        found->rank, functions.size());
    const std::vector<NamedExpression> others = dependent(functions, slopes, found->points);
    if (!others.empty() && others.size() + found->rank == functions.size())
      proof.reason += fmt::format("; {} depend{} on those before", listed(others),
                                  others.size() == 1 ? "s" : "");
  } else {
    proof.reason = fmt::format("the gradients have rank {} at the points tried", found->rank);
  }
}

/// The rank of the bracket; the gradients of Casimir functions span its kernel.
std::optional<GenericRank> bracket_rank(Prover& prover) {
  return rank_with_conditions(prover, structure_matrix(prover), [&] {
    std::vector<KernelCandidate> candidates;
    for (auto& slope : gradients(prover, real_everywhere(prover.model().casimirs)))
      candidates.push_back({std::move(slope)});
    return candidates;
  });
}

/// At least so many of the rows are independent.
std::size_t independent_rows(Prover& prover, const PolynomialRows& rows) {
  if (rows.empty()) return 0;
  const auto found = generic_rank(prover, rows);
  return found ? found->rank : 0;
}

void decide_rank(Prover& prover, Proof& proof) {
  const auto found = bracket_rank(prover);
  if (!found) {
    proof.reason = "no point of the domain was found to take the rank at";
    return;
  }
  if (!found->uneven.empty()) {
    proof.reason = found->uneven;
    return;
  }
  // One of the case's own claims may be refuted: what is not one is not counted.
  std::vector<NamedExpression> known = real_everywhere(prover.model().casimirs);
  std::erase_if(known, [&](const NamedExpression& f) { return !is_casimir(prover, f); });
  const PolynomialRows casimirs = gradients(prover, known);
  const std::size_t independent = independent_rows(prover, casimirs);
  proof.name = fmt::format("rank {}", found->rank);
  proof.rank = found->rank;
  if (!found->exact) {
    proof.reason = fmt::format(
        "the rank is at least {}, with {} independent Casimir functions known in dimension {}",
        found->rank, independent, prover.dimension());
    return;
  }
  proof.verdict = Verdict::proved;
  proof.evidence =
      fmt::format("leaves of dimension {} in dimension {}, {} independent Casimir function{}; {}",
                  found->rank, prover.dimension(), independent, independent == 1 ? "" : "s",
                  found->points.empty() ? "the bracket is constant"
                                        : "rank taken at " + text_of(found->points));
  say_where(proof, found->where, found->nonzero);
  prover.check_inhabited(proof, {});
}

/// For each function the set of those that it commutes with, itself included.
std::vector<unsigned> commuting(Prover& prover, const std::vector<NamedExpression>& functions) {
  std::vector<unsigned> sets(functions.size());
  for (std::size_t i = 0; i < functions.size(); ++i) {
    sets[i] |= 1U << i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!prover.is_zero(prover.bracket(functions[i].value, functions[j].value))) continue;
      sets[i] |= 1U << j;
      sets[j] |= 1U << i;
    }
  }
  return sets;
}

/// The largest set, up to `needed`, of functions in involution with the first one whose fields have
/// independent values.
unsigned largest_set(const std::vector<unsigned>& commutes, RealPoint& point,
                     const PolynomialRows& flows, std::size_t needed) {
  unsigned best = 0;
  const auto size = [](unsigned set) { return static_cast<std::size_t>(std::popcount(set)); };
  for (unsigned set = 1; set < (1U << flows.size()) && size(best) < needed; set += 2) {
    if (size(set) <= size(best) || size(set) > needed) continue;
    bool involutive = true;
    PolynomialRows rows;
    for (std::size_t i = 0; i < flows.size() && involutive; ++i) {
      if ((set >> i & 1U) == 0) continue;
      involutive = (set & ~commutes[i]) == 0;
      rows.push_back(flows[i]);
    }
    if (involutive && point.rank(rows) == rows.size()) best = set;
  }
  return best;
}

/// Sets of functions in involution, one for each piece of the domain.
struct SetsOnPieces {
  bool complete = false;      ///< each has as many as are needed
  std::size_t least = 0;      ///< of the piece with the smallest set
  unsigned set = 0;           ///< of the first piece
  std::vector<RealPoint> at;  ///< a point on each; or on the one with too few
  std::string where;
};

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
      if (result.at.empty()) result.set = set;
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
    PolynomialRows rows;
    bool involutive = true;
    for (std::size_t i = 0; i < flows.size(); ++i) {
      if ((set >> i & 1U) == 0) continue;
      involutive = involutive && (commutes[i] & set) == set;
      rows.push_back(flows[i]);
    }
    if (involutive && are_always_independent(prover, rows)) return set;
  }
  return std::nullopt;
}

/// Integrals in involution that are independent on the generic leaf: as many as half its dimension?
void decide_liouville(Prover& prover, Proof& proof) {
  const std::vector<NamedExpression> functions = with_hamiltonian(prover.model(), {});
  const auto leaf = bracket_rank(prover);
  if (!leaf) {
    proof.reason = "no point of the domain was found to take the rank of the bracket at";
    return;
  }
  if (!leaf->uneven.empty()) {
    proof.reason = leaf->uneven;
    return;
  }
  if (!leaf->exact) {
    proof.reason =
        fmt::format("the leaves are only known to have dimension {} or more", leaf->rank);
    return;
  }
  constexpr std::size_t kMaxFunctions = 16;
  if (functions.size() > kMaxFunctions) {
    proof.reason =
        fmt::format("more than {} integrals: their choice is not searched", kMaxFunctions);
    return;
  }
  const std::size_t needed = leaf->rank / 2;
  if (functions.size() < needed) {
    proof.reason =
        fmt::format("leaves of dimension {} need {} independent integrals in involution; {} known",
                    leaf->rank, needed, functions.size());
    return;
  }
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
    return;
  }
  const auto found = sets_on_pieces(prover, flows, commutes, needed);
  if (!found.complete) {
    proof.reason = fmt::format(
        "leaves of dimension {} need {} independent integrals in involution; {} known{}",
        leaf->rank, needed, found.least, found.at.empty() ? "" : " at " + text_of(found.at));
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
  prover.check_inhabited(proof, {});
}

/// More integrals that are independent on the generic leaf than Liouville's theorem needs; whether
/// they commute is not asked. The rank of their flows counts them: on a leaf a flow vanishes
/// exactly where the differential of its function does. A function that is not proved to be an
/// integral is not counted, however independent it is.
void decide_superintegrability(Prover& prover, Proof& proof) {
  std::vector<NamedExpression> functions = with_hamiltonian(prover.model(), {});
  std::erase_if(functions, [&](const NamedExpression& f) {
    return !prover.is_zero(prover.rate(prover.convert(f.value)));
  });
  const auto leaf = bracket_rank(prover);
  if (!leaf || !leaf->uneven.empty() || !leaf->exact) {
    proof.reason =
        !leaf ? "no point of the domain was found to take the rank of the bracket at"
        : !leaf->uneven.empty()
            ? leaf->uneven
            : fmt::format("the leaves are only known to have dimension {} or more", leaf->rank);
    return;
  }
  const std::size_t half = leaf->rank / 2;
  PolynomialRows flows;
  for (const NamedExpression& f : functions) flows.push_back(prover.flow(f.value));
  auto found = flows.empty() ? std::nullopt : rank_with_conditions(prover, flows);
  if (!found || !found->uneven.empty()) {
    proof.reason = found ? found->uneven : "no point of the domain was found to take flows at";
    return;
  }
  if (half == 0 || found->rank <= half) {
    proof.reason =
        fmt::format("leaves of dimension {} need more than {} independent integrals; {} known",
                    leaf->rank, half, found->rank);
    return;
  }
  proof.verdict = Verdict::proved;
  const std::vector<NamedExpression> others = dependent(functions, flows, found->points);
  std::vector<NamedExpression> chosen;
  for (const NamedExpression& f : functions) {
    if (std::none_of(others.begin(), others.end(),
                     [&](const NamedExpression& other) { return other.name == f.name; }))
      chosen.push_back(f);
  }
  proof.evidence = fmt::format(
      "{} are independent on leaves of dimension {}, where {} would do{}{}", listed(chosen),
      leaf->rank, half, found->rank + 1 == leaf->rank ? ": as many as there can be" : "",
      found->points.empty() ? "" : " (at " + text_of(found->points) + ")");
  if (!others.empty() && found->exact)
    proof.evidence +=
        fmt::format("; {} follow{} from them there", listed(others), others.size() == 1 ? "s" : "");
  say_where(proof, leaf->where, leaf->nonzero);
  say_where(proof, found->where != leaf->where ? found->where : "", found->nonzero);
  prover.check_inhabited(proof, {});
}

}  // namespace

std::vector<Claim> independence_claims(const Model& model) {
  const std::vector<NamedExpression> functions = with_hamiltonian(model, model.casimirs);
  if (functions.size() < 2) return {};
  return {
      {ClaimKind::independence,
       listed(functions),
       true,
       [functions](Prover& prover, Proof& proof) { decide_independence(prover, proof, functions); },
       {},
       values_of(functions),
       false,
       model.poisson ? Subject::bracket : Subject::motion}};
}

std::vector<Claim> rank_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{ClaimKind::rank,
           "rank",
           true,
           decide_rank,
           {},
           values_of(real_everywhere(model.casimirs)),
           false,
           Subject::bracket}};
}

std::vector<Claim> liouville_claims(const Model& model) {
  if (!model.poisson || model.time) return {};
  std::vector<Claim> claims{{ClaimKind::liouville,
                             "Liouville integrability",
                             true,
                             decide_liouville,
                             {},
                             values_of(with_hamiltonian(model, real_everywhere(model.casimirs))),
                             false,
                             Subject::bracket}};
  if (!model.superintegrable) return claims;
  claims.push_back(claims.front());
  claims.back().name = "superintegrability";
  claims.back().decide = decide_superintegrability;
  return claims;
}

}  // namespace casimir
