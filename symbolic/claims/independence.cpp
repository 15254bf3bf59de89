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

void decide_independence(Prover& prover, Proof& proof,
                         const std::vector<NamedExpression>& functions) {
  const PolynomialRows slopes = gradients(prover, functions);
  // The flow of a function that commutes with all is orthogonal to all gradients.
  const auto kernel = [&] {
    std::vector<KernelCandidate> candidates;
    if (!prover.model().poisson) {
      candidates.push_back({prover.field()});
      return candidates;
    }
    for (const NamedExpression& f : functions) {
      candidates.push_back({prover.flow(f.value), [&](std::size_t i) {
                              return prover.bracket(functions[i].value, f.value).is_zero();
                            }});
    }
    return candidates;
  };
  const auto found = generic_rank(prover, slopes, kernel);
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

/// The rank of the bracket; the gradients of Casimir functions span its kernel.
std::optional<GenericRank> bracket_rank(Prover& prover) {
  return generic_rank(prover, structure_matrix(prover), [&] {
    std::vector<KernelCandidate> candidates;
    for (auto& slope : gradients(prover, prover.model().casimirs))
      candidates.push_back({std::move(slope)});
    return candidates;
  });
}

void decide_rank(Prover& prover, Proof& proof) {
  const auto found = bracket_rank(prover);
  if (!found) {
    proof.reason = "no exact point was found to take the rank at";
    return;
  }
  const PolynomialRows casimirs = gradients(prover, prover.model().casimirs);
  const std::size_t independent =
      have_values(prover, casimirs) ? rank(values_at(casimirs, found->point)) : 0;
  proof.name = fmt::format("rank {}", found->rank);
  if (!found->exact) {
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

/// For each function the set of those that it commutes with, itself included.
std::vector<unsigned> commuting(Prover& prover, const std::vector<NamedExpression>& functions) {
  std::vector<unsigned> sets(functions.size());
  for (std::size_t i = 0; i < functions.size(); ++i) {
    sets[i] |= 1U << i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!prover.bracket(functions[i].value, functions[j].value).is_zero()) continue;
      sets[i] |= 1U << j;
      sets[j] |= 1U << i;
    }
  }
  return sets;
}

/// The largest set, up to `needed`, of functions in involution with the first one whose fields have
/// independent values.
unsigned largest_set(const std::vector<unsigned>& commutes,
                     const std::vector<std::vector<cln::cl_RA>>& values, std::size_t needed) {
  unsigned best = 0;
  const auto size = [](unsigned set) { return static_cast<std::size_t>(std::popcount(set)); };
  for (unsigned set = 1; set < (1U << values.size()) && size(best) < needed; set += 2) {
    if (size(set) <= size(best) || size(set) > needed) continue;
    bool involutive = true;
    std::vector<std::vector<cln::cl_RA>> rows;
    for (std::size_t i = 0; i < values.size() && involutive; ++i) {
      if ((set >> i & 1U) == 0) continue;
      involutive = (set & ~commutes[i]) == 0;
      rows.push_back(values[i]);
    }
    if (involutive && rank(rows) == rows.size()) best = set;
  }
  return best;
}

/// Integrals in involution that are independent on the generic leaf: as many as half its dimension?
void decide_liouville(Prover& prover, Proof& proof) {
  const std::vector<NamedExpression> functions = with_hamiltonian(prover.model(), {});
  const auto leaf = bracket_rank(prover);
  if (!leaf) {
    proof.reason = "no exact point was found to take the rank of the bracket at";
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
  std::size_t best = 0;
  constexpr int kPoints = 4;
  for (int k = 0; k < kPoints && have_values(prover, flows); ++k) {
    const auto point = prover.random_point({});
    if (!point) continue;
    const unsigned set = largest_set(commutes, values_at(flows, *point), needed);
    best = std::max(best, static_cast<std::size_t>(std::popcount(set)));
    if (best < needed || needed == 0) continue;
    std::vector<NamedExpression> chosen;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      if ((set >> i & 1U) != 0) chosen.push_back(functions[i]);
    }
    proof.verdict = Verdict::proved;
    proof.evidence =
        chosen.size() == 1
            ? fmt::format("{} is enough on leaves of dimension {}; it is not constant at {}",
                          listed(chosen), leaf->rank, point_text(prover, *point))
            : fmt::format("{} are in involution and independent on leaves of dimension {} (at {})",
                          listed(chosen), leaf->rank, point_text(prover, *point));
    return;
  }
  proof.reason =
      fmt::format("leaves of dimension {} need {} independent integrals in involution; {} known",
                  leaf->rank, needed, best);
}

}  // namespace

std::vector<Claim> independence_claims(const Model& model) {
  const std::vector<NamedExpression> functions = with_hamiltonian(model, model.casimirs);
  if (functions.size() < 2) return {};
  return {
      {"independence",
       listed(functions),
       true,
       [functions](Prover& prover, Proof& proof) { decide_independence(prover, proof, functions); },
       {},
       values_of(functions)}};
}

std::vector<Claim> rank_claims(const Model& model) {
  if (!model.poisson) return {};
  return {{"rank", "rank", true, decide_rank, {}, values_of(model.casimirs)}};
}

std::vector<Claim> liouville_claims(const Model& model) {
  if (!model.poisson || model.time || !model.hamiltonian) return {};
  return {{"liouville",
           "Liouville integrability",
           true,
           decide_liouville,
           {},
           values_of(with_hamiltonian(model, model.casimirs))}};
}

}  // namespace casimir
