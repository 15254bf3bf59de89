// Functional independence and the rank of the bracket: facts that are read off exact ranks at a
// rational point.
#include <fmt/format.h>

#include <algorithm>

#include "symbolic/proof/claims/claim.hpp"
#include "symbolic/proof/claims/on_constraints.hpp"
#include "symbolic/proof/claims/ranks.hpp"

namespace casimir {
namespace {

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
      if (prover.has_motion()) candidates.push_back({prover.field()});
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
    prover.say_where_values_are(proof);
    prover.check_inhabited(proof, {});
    require_independence_on_constraints(prover, proof, functions);
  } else if (found->exact) {
    proof.verdict = Verdict::refuted;
    proof.reason = fmt::format(
        "only {} of the {} functions are independent: every larger minor of their gradients "
        "vanishes identically",
        found->rank, functions.size());
    const auto others = dependent(functions, slopes, found->points);
    if (others && !others->empty() && others->size() + found->rank == functions.size())
      proof.reason += fmt::format("; {} depend{} on those before", listed(*others),
                                  others->size() == 1 ? "s" : "");
  } else {
    proof.reason = fmt::format("the gradients have rank {} at the points tried", found->rank);
  }
}

/// At least so many of the rows are independent; nothing where no point was found to tell.
std::optional<std::size_t> independent_rows(Prover& prover, const PolynomialRows& rows) {
  if (rows.empty()) return 0;
  const auto found = generic_rank(prover, rows);
  return found ? std::optional(found->rank) : std::nullopt;
}

/// "2 independent Casimir functions", or that they are not counted.
/// \param all  whether none of the case's was left out
std::string casimirs_counted(std::optional<std::size_t> independent, bool all) {
  if (!independent) return "Casimir functions that are not counted, for want of a point,";
  return fmt::format("{} independent {}Casimir function{}", *independent, all ? "" : "polynomial ",
                     independent == 1 ? "" : "s");
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
  const bool all = known.size() == prover.model().casimirs.size();
  std::erase_if(known, [&](const NamedExpression& f) { return !is_casimir(prover, f); });
  const PolynomialRows casimirs = gradients(prover, known);
  const std::string independent = casimirs_counted(independent_rows(prover, casimirs), all);
  proof.name = fmt::format("rank {}", found->rank);
  proof.rank = found->rank;
  if (!found->exact) {
    proof.reason = fmt::format("the rank is at least {}, with {} known in dimension {}",
                               found->rank, independent, prover.dimension());
    return;
  }
  proof.verdict = Verdict::proved;
  proof.evidence = fmt::format("leaves of dimension {} in dimension {}, {}; {}", found->rank,
                               prover.dimension(), independent,
                               found->points.empty() ? "the bracket is constant"
                                                     : "rank taken at " + text_of(found->points));
  say_where(proof, found->where, found->nonzero);
  prover.say_where_values_are(proof);
  prover.check_inhabited(proof, {});
  require_on_constraints(prover, proof, {{structure_rows(prover), found->rank}});
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

}  // namespace casimir
