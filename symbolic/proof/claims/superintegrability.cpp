#include "symbolic/proof/claims/superintegrability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/ranks.hpp"
#include "symbolic/proof/claims/real_functions.hpp"

namespace casimir {
namespace {

/// Independent integrals with their flows. On a leaf a flow vanishes exactly where the differential
/// of its function does, so that flows count there.
struct Chosen {
  std::vector<NamedExpression> functions, others;  ///< others follow from the functions
  std::string left_out;  ///< those that are not counted, as the end of a reason
  PolynomialRows flows;
  GenericRank rank;  ///< of all flows together
};

/// Those of the functions whose flows, which are constant, add nothing to the ones before them:
/// they have a rank, and no points at which it was taken.
std::optional<std::vector<NamedExpression>> dependent_of_constant(
    Prover& prover, const std::vector<NamedExpression>& functions, const PolynomialRows& flows) {
  std::vector<NamedExpression> result;
  PolynomialRows chosen;
  for (std::size_t i = 0; i < functions.size(); ++i) {
    PolynomialRows more = chosen;
    more.push_back(flows[i]);
    const auto rank = rank_with_conditions(prover, more);
    if (!rank || !rank->exact || !rank->uneven.empty() || !rank->points.empty())
      return std::nullopt;
    if (rank->rank > chosen.size())
      chosen = std::move(more);
    else
      result.push_back(functions[i]);
  }
  return result;
}

/// A function that is not proved to be an integral is not counted, however independent it is.
std::optional<Chosen> independent_integrals(Prover& prover, Proof& proof) {
  std::vector<NamedExpression> functions = real_ones(prover, with_hamiltonian(prover.model(), {}));
  std::erase_if(functions, [&](const NamedExpression& f) {
    return !prover.is_zero(prover.rate(prover.convert(f.value)));
  });
  Chosen result;
  result.left_out = take_out_jumping(prover, functions);
  PolynomialRows flows;
  for (const NamedExpression& f : functions) flows.push_back(prover.flow(f.value));
  auto found = flows.empty() ? std::nullopt : rank_with_conditions(prover, flows);
  if (!found || !found->uneven.empty()) {
    proof.reason = (found ? found->uneven : "no point of the domain was found to take flows at") +
                   result.left_out;
    return std::nullopt;
  }
  auto others = found->points.empty() ? dependent_of_constant(prover, functions, flows)
                                      : dependent(functions, flows, found->points);
  if (!others) {
    proof.reason = "on other parts of the domain other integrals are independent (at " +
                   text_of(found->points) + ")";
    return std::nullopt;
  }
  result.others = std::move(*others);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if (std::ranges::any_of(result.others, [&](const NamedExpression& other) {
          return other.name == functions[i].name;
        }))
      continue;
    result.functions.push_back(functions[i]);
    result.flows.push_back(flows[i]);
  }
  result.rank = std::move(*found);
  return result;
}

/// The matrix of the brackets of the functions.
PolynomialRows brackets(Prover& prover, const std::vector<NamedExpression>& functions) {
  PolynomialRows rows;
  for (const NamedExpression& f : functions) {
    auto& row = rows.emplace_back();
    for (const NamedExpression& g : functions) row.push_back(prover.bracket(f.value, g.value));
  }
  return rows;
}

/// Whether the brackets are functions of the functions: their flows add nothing to the rank.
/// In the kernel of flows are the differentials of what commutes with all of these functions.
bool close(Prover& prover, const Chosen& chosen, const PolynomialRows& brackets) {
  const FunctionRing& ring = prover.ring();
  PolynomialRows rows = chosen.flows;
  for (std::size_t i = 0; i < brackets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (prover.is_zero(brackets[i][j])) continue;
      const bool known = std::ranges::any_of(chosen.functions, [&](const NamedExpression& f) {
        const Polynomial own = prover.convert(f.value);
        return own == brackets[i][j] || own == -brackets[i][j];
      });
      if (!known) rows.push_back(prover.flow(ring.expression(brackets[i][j])));
    }
  }
  if (rows.size() == chosen.flows.size()) return true;
  const auto found = generic_rank(prover, rows, [&] {
    std::vector<KernelCandidate> candidates;
    for (const auto* list : {&prover.model().casimirs, &chosen.functions}) {
      for (auto& slope : gradients(prover, real_everywhere(*list)))
        candidates.push_back({std::move(slope)});
    }
    return candidates;
  });
  return found && found->exact && found->uneven.empty() && found->rank == chosen.functions.size();
}

}  // namespace

void decide_superintegrability(Prover& prover, Proof& proof) {
  const auto leaf = bracket_rank(prover);
  if (!leaf || !leaf->uneven.empty() || !leaf->exact) {
    proof.reason =
        !leaf ? "no point of the domain was found to take the rank of the bracket at"
        : !leaf->uneven.empty()
            ? leaf->uneven
            : fmt::format("the leaves are only known to have dimension {} or more", leaf->rank);
    return;
  }
  if (has_complex_motion(prover)) {
    proof.reason = "the Hamiltonian or the bracket is not real";
    return;
  }
  if (!is_poisson(prover)) {
    proof.reason = "the Jacobi identity is not proved";
    return;
  }
  auto chosen = independent_integrals(prover, proof);
  if (!chosen) return;
  const std::size_t half = leaf->rank / 2, count = chosen->functions.size();
  if (half == 0 || count <= half) {
    proof.reason =
        fmt::format("leaves of dimension {} need more than {} independent integrals; {} known{}",
                    leaf->rank, half, count, chosen->left_out);
    return;
  }
  const PolynomialRows matrix = brackets(prover, chosen->functions);
  const auto rank = rank_with_conditions(prover, matrix);
  const std::size_t isotropic = 2 * (count - half);
  if (!rank || !rank->exact || rank->rank != isotropic) {
    proof.reason = fmt::format(
        "{} are independent, but their joint levels are isotropic only where the matrix of their "
        "brackets has rank {}; it has {}{}{}",
        listed(chosen->functions), isotropic, rank && !rank->exact ? "at least " : "",
        rank ? std::to_string(rank->rank) : "no rank that was found", chosen->left_out);
    return;
  }
  if (!close(prover, *chosen, matrix)) {
    proof.reason = fmt::format("that the brackets of {} are functions of them is not shown",
                               listed(chosen->functions));
    return;
  }
  proof.verdict = Verdict::proved;
  const GenericRank& flows = chosen->rank;
  proof.evidence = fmt::format(
      "{} are independent on leaves of dimension {}, where {} would do{}{}; their brackets are "
      "functions of them and have rank {}: on joint levels that are compact the motion is on tori "
      "of "
      "dimension {}",
      listed(chosen->functions), leaf->rank, half,
      count + 1 == leaf->rank ? ": as many as there can be" : "",
      flows.points.empty() ? "" : " (at " + text_of(flows.points) + ")", isotropic,
      leaf->rank - count);
  if (!chosen->others.empty() && flows.exact)
    proof.evidence += fmt::format("; {} follow{} from them there", listed(chosen->others),
                                  chosen->others.size() == 1 ? "s" : "");
  say_where(proof, leaf->where, leaf->nonzero);
  say_where(proof, flows.where != leaf->where ? flows.where : "", flows.nonzero);
  say_where(proof, "", rank->nonzero);
  say_where(proof, "", where_beside_poles(prover, chosen->functions));
  prover.say_where_values_are(proof);
  prover.check_inhabited(proof, {});
  require_on_constraints(
      prover, proof,
      {{structure_rows(prover), leaf->rank}, {chosen->flows, count}, {matrix, isotropic}});
}

}  // namespace casimir
