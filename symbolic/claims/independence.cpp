// Functional independence, the rank of the bracket and the count of Liouville's theorem: facts that
// are read off exact ranks at a rational point.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>

#include "symbolic/claims/claim.hpp"
#include "symbolic/generic_rank.hpp"

namespace casimir {
namespace {

std::vector<NamedExpression> with_hamiltonian(const Model& model,
                                              std::vector<NamedExpression> functions) {
  if (model.hamiltonian && !model.time) functions.push_back({"H", *model.hamiltonian, {}});
  functions.insert(functions.end(), model.integrals.begin(), model.integrals.end());
  return functions;
}

std::string listed(const std::vector<NamedExpression>& functions) {
  return fmt::format("{}", fmt::join(names_of(functions), ", "));
}

PolynomialRows gradients(Prover& prover, const std::vector<NamedExpression>& functions) {
  PolynomialRows rows;
  for (const NamedExpression& f : functions)
    rows.push_back(prover.gradient(prover.ring().convert(f.value)));
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

void decide_independence(Prover& prover, Proof& proof,
                         const std::vector<NamedExpression>& functions) {
  const auto found = generic_rank(prover, gradients(prover, functions));
  if (!found) {
    proof.reason = "no exact point was found to take the gradients at";
  } else if (found->rank == functions.size()) {
    proof.verdict = Verdict::proved;
    proof.evidence = "the gradients are independent at " + point_text(prover, found->point);
  } else if (found->exact) {
    proof.verdict = Verdict::refuted;
    proof.reason = fmt::format(
        "only {} of the {} functions are independent: every larger minor of their gradients "
        "vanishes identically",
        found->rank, functions.size());
  } else {
    proof.reason = fmt::format("the gradients have rank {} at the points tried", found->rank);
  }
}

void decide_rank(Prover& prover, Proof& proof) {
  const auto found = generic_rank(prover, structure_matrix(prover));
  if (!found) {
    proof.reason = "no exact point was found to take the rank at";
    return;
  }
  const auto casimirs = prover.model().casimirs.empty()
                            ? std::nullopt
                            : generic_rank(prover, gradients(prover, prover.model().casimirs));
  const std::size_t independent = casimirs ? casimirs->rank : 0;
  const bool exact = found->exact || found->rank + independent == prover.dimension();
  proof.name = fmt::format("rank {}", found->rank);
  if (!exact) {
    proof.reason = fmt::format(
        "the rank is at least {}, with {} independent Casimir functions known in dimension {}",
        found->rank, independent, prover.dimension());
    return;
  }
  proof.verdict = Verdict::proved;
  proof.evidence = fmt::format(
      "leaves of dimension {} in dimension {}, {} independent Casimir function{}; rank taken at {}",
      found->rank, prover.dimension(), independent, independent == 1 ? "" : "s",
      point_text(prover, found->point));
}

/// The vector fields J grad F.
PolynomialRows fields(Prover& prover, const PolynomialRows& slopes) {
  PolynomialRows rows;
  for (const auto& slope : slopes) {
    rows.emplace_back();
    for (std::size_t i = 0; i < prover.dimension(); ++i) {
      Polynomial sum(prover.ring().ring());
      for (std::size_t j = 0; j < prover.dimension(); ++j)
        sum += prover.bracket_entry(i, j) * slope[j];
      rows.back().push_back(std::move(sum));
    }
  }
  return rows;
}

/// Integrals in involution that are independent on the generic leaf: as many as half its dimension?
void decide_liouville(Prover& prover, Proof& proof) {
  const std::vector<NamedExpression> functions = with_hamiltonian(prover.model(), {});
  const auto leaf = generic_rank(prover, structure_matrix(prover));
  if (!leaf) {
    proof.reason = "no exact point was found to take the rank of the bracket at";
    return;
  }
  const std::size_t needed = leaf->rank / 2;
  const std::size_t count = functions.size();
  constexpr std::size_t kMaxFunctions = 16;
  if (count > kMaxFunctions) {
    proof.reason =
        fmt::format("more than {} integrals: their choice is not searched", kMaxFunctions);
    return;
  }
  std::vector<unsigned> commutes(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const bool zero =
          i == j || prover.ring()
                        .numerator(prover.bracket(prover.ring().convert(functions[i].value),
                                                  prover.ring().convert(functions[j].value)))
                        .is_zero();
      if (zero) commutes[i] |= 1U << j;
    }
  }
  const PolynomialRows all = fields(prover, gradients(prover, functions));
  std::size_t best = 0;
  for (unsigned set = 1; set < (1U << count); ++set) {
    if ((set & 1U) == 0 || static_cast<std::size_t>(std::popcount(set)) > needed) continue;
    PolynomialRows rows;
    std::vector<NamedExpression> chosen;
    bool involutive = true;
    for (std::size_t i = 0; i < count; ++i) {
      if ((set >> i & 1U) == 0) continue;
      involutive = involutive && (set & ~commutes[i]) == 0;
      rows.push_back(all[i]);
      chosen.push_back(functions[i]);
    }
    if (!involutive || rows.size() <= best) continue;
    const auto independent = generic_rank(prover, rows);
    if (!independent || independent->rank < rows.size()) continue;
    best = rows.size();
    if (best < needed) continue;
    proof.verdict = Verdict::proved;
    proof.evidence =
        fmt::format("{} are in involution and independent on leaves of dimension {} (at {})",
                    listed(chosen), leaf->rank, point_text(prover, independent->point));
    return;
  }
  proof.reason = fmt::format(
      "leaves of dimension {} or more need {} independent integrals in involution; {} known",
      leaf->rank, needed, best);
}

}  // namespace

std::vector<Claim> independence_claims(const Model& model) {
  const std::vector<NamedExpression> functions = with_hamiltonian(model, model.casimirs);
  if (functions.size() < 2) return {};
  return {{"independence", listed(functions), true, [functions](Prover& prover, Proof& proof) {
             decide_independence(prover, proof, functions);
           }}};
}

std::vector<Claim> rank_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{"rank", "rank", true, decide_rank}};
}

std::vector<Claim> liouville_claims(const Model& model) {
  if (!model.poisson || model.time) return {};
  return {{"liouville", "Liouville integrability", true, decide_liouville}};
}

}  // namespace casimir
